"""The drives that are compared. Steering is linear between rows, acceleration constant."""
import dataclasses
import math



@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    what: str
    models: tuple
    speed: float          # at the start [m/s]
    duration: float       # [s]
    steering: tuple       # (time [s], angle of the road wheels [rad]), linear in between
    acceleration: tuple = ((0.0, 0.0),)  # (from time [s], [m/s^2]): torque = mass * radius * this
    front_brake_share: float = 0.66  # the package's own T_sb for this car
    row_time: float = 0.1  # [s]

    def times(self):
        return [i * self.row_time for i in range(round(self.duration / self.row_time) + 1)]

    def angle(self, time):
        knots = self.steering
        for (t0, a0), (t1, a1) in zip(knots, knots[1:]):
            if time <= t1:
                return a0 + (a1 - a0) * max(0.0, time - t0) / (t1 - t0)
        return knots[-1][1]

    def pull(self, time):
        return [value for start, value in self.acceleration if start <= time + 1e-9][-1]

    def inputs(self):
        """For each row: steering rate [rad/s] and acceleration until the next row."""
        return [((self.angle(t + self.row_time) - self.angle(t)) / self.row_time, self.pull(t))
                for t in self.times()]


def ramp(angle, seconds, start=0.2):
    return ((0.0, 0.0), (start, 0.0), (start + seconds, angle))


def sine_with_dwell(amplitude, hertz=0.7, dwell=0.5, start=0.2):
    """One period of a sine that waits at its second peak; by straight pieces of 0.1 s."""
    knots = [(0.0, 0.0)]
    period, peak = 1.0 / hertz, 0.75 / hertz
    for i in range(math.ceil((period + dwell) / 0.1) + 1):
        t = 0.1 * i
        phase = t if t < peak else max(peak, t - dwell)
        knots.append((start + t, amplitude * math.sin(2.0 * math.pi * min(phase, period) / period)))
    return tuple(knots)


ROLLING = ("st", "std", "mb", "mb_upright")
SLIDING = ("std", "mb", "mb_upright")
BRAKING = ("std", "std_plain", "mb", "mb_upright")
CASES = (
    Case("braking", "straight: rolling, then braking gently, then harder, then driving", SLIDING,
         25.0, 4.0, ((0.0, 0.0),), ((0.0, 0.0), (0.5, -2.0), (1.5, -4.0), (3.0, 1.5))),
    Case("corner_02g", "steady corner, rolling freely, 0.2 g", ROLLING,
         15.0, 4.0, ramp(0.0225, 0.2)),
    Case("corner_06g", "steady corner, rolling freely, 0.6 g", ROLLING,
         15.0, 4.0, ramp(0.0675, 0.2)),
    Case("step_small", "step steer, 0.16 g", ROLLING,
         20.0, 2.0, ramp(0.010, 0.05), row_time=0.05),
    Case("step_large", "step steer, 0.75 g", SLIDING,
         20.0, 2.0, ramp(0.050, 0.15), row_time=0.05),
    Case("sine_with_dwell", "sine with dwell at 0.7 Hz, 0.6 g", SLIDING,
         20.0, 4.0, sine_with_dwell(0.040)),
    Case("brake_in_corner", "steady corner at 0.3 g, then braking with 4 m/s^2", BRAKING,
         20.0, 3.0, ramp(0.020, 0.1), ((0.0, 0.0), (1.0, -4.0), (2.5, 0.0))),
    Case("drift_entry", "corner, then all brake torque on the rear wheels until they lock", BRAKING,
         15.0, 1.2, ramp(0.10, 0.30), ((0.0, 0.0), (0.7, -9.0), (1.1, 0.0)), front_brake_share=0.0),
)
