"""Writes SYNTHETIC records (schema saca.drive/1, docs/formats.md) for the test of the manoeuvre's page.

    make_drive.py {slide,draws,braking,bend,instant} FILE

Nobody drove or simulated these manoeuvres. The motion is given, as closed forms: the centre of mass decelerates evenly along
an even arc while the body turns by a quintic. From it follow, by kinematics and Newton's law, the velocities and accelerations in
the body and the sums of the tyre forces; each wheel takes its share by its load. Every command says that it is test data.
Not to be quoted.
"""

import json
import math
import random
import sys

STEP = 0.01  # [s]
GRAVITY = 9.81
CAR = {"name": "synthetic_car", "mass_kg": 1700, "front_arm_m": 1.35, "rear_arm_m": 1.45, "track_width_m": 1.6,
       "wheel_radius_m": 0.32, "length_m": 4.7, "width_m": 1.9, "front_end_m": 2.25, "steering_limit_deg": 35.0,
       "motor_limit_Nm": 3200, "brake_limit_Nm": 3000}
WHEELS = [("front left", 1.35, 0.8), ("front right", 1.35, -0.8), ("rear left", -1.45, 0.8), ("rear right", -1.45, -0.8)]
MASS_HEIGHT = 0.5  # [m]


def wrapped(degrees):
    """In (-180, 180]."""
    return 180.0 - (180.0 - degrees) % 360.0


class Motion:
    """From `speed` to rest at `deceleration`, on an arc of `bend` [1/m]; meanwhile turned by `turn_deg` against the arc."""

    def __init__(self, speed, deceleration, turn_deg=0.0, bend=0.0, begin=0.15):
        self.speed, self.deceleration, self.turn, self.bend, self.begin = speed, deceleration, math.radians(turn_deg), bend, begin
        self.duration = begin + speed / deceleration

    def at(self, t):
        """x, y, heading, velocity in W, yaw rate, acceleration in W."""
        braked = min(max(0.0, t - self.begin), self.speed / self.deceleration)
        v = self.speed - self.deceleration * braked
        s = self.speed * min(t, self.begin) + self.speed * braked - self.deceleration * braked**2 / 2
        course = self.bend * s
        x, y = (math.sin(course) / self.bend, (1 - math.cos(course)) / self.bend) if self.bend else (s, 0.0)
        rest = self.duration - self.begin
        u = braked / rest
        turned = self.turn * u**3 * (10 - 15 * u + 6 * u**2)
        rate = self.turn * 30 * u**2 * (1 - u)**2 / rest + self.bend * v
        along, across = -self.deceleration if self.begin <= t < self.duration else 0.0, self.bend * v * v
        c, d = math.cos(course), math.sin(course)
        return x, y, course + turned, (v * c, v * d), rate, (along * c - across * d, along * d + across * c)


def into(frame, vector):
    c, s = math.cos(frame), math.sin(frame)
    return vector[0] * c + vector[1] * s, -vector[0] * s + vector[1] * c


def steering(motion, t):
    """[deg], commanded: into the turn, then against it."""
    u = min(1.0, max(0.0, (t - 0.05) / (motion.duration - 0.05)))
    return 25.0 * math.sin(2 * math.pi * u) * math.copysign(1.0, motion.turn) if motion.turn else 0.0


def wheel_samples(wheel, motion, grip, times):
    """One wheel's time series. It rolls until the braking starts; then it slips by 12 %, and the rear of a car that is turned locks."""
    name, ahead, left = wheel
    keys = ["angle_deg", "load_N", "F_x_N", "F_y_N", "peak_N", "slip", "speed_mps", "brake_Nm", "brake_command_Nm"]
    out = {key: [] for key in keys}
    front = ahead > 0
    share = (CAR["rear_arm_m"] if front else CAR["front_arm_m"]) / (CAR["front_arm_m"] + CAR["rear_arm_m"]) / 2
    for t in times:
        _, _, heading, v_W, rate, a_W = motion.at(t)
        v, a = into(heading, v_W), into(heading, a_W)
        angle = steering(motion, t - 0.05) if front else 0.0
        shift = CAR["mass_kg"] * MASS_HEIGHT
        load = (CAR["mass_kg"] * GRAVITY * share - math.copysign(1, ahead) * shift * a[0] / (CAR["front_arm_m"] + CAR["rear_arm_m"]) / 2
                - math.copysign(1, left) * shift * a[1] / CAR["track_width_m"] / 2)
        force = into(math.radians(angle), [CAR["mass_kg"] * x * load / (CAR["mass_kg"] * GRAVITY) for x in a])
        hub = into(math.radians(angle), (v[0] - rate * left, v[1] + rate * ahead))
        braking = t >= motion.begin and t < motion.duration
        slip = (1.0 if motion.turn and not front else 0.12) if braking else 0.0
        rim = hub[0] * (1 - slip)
        command = 3000.0 if t >= motion.begin - 0.04 and t < motion.duration else 0.0
        torque = command * (1 - math.exp(-max(0.0, t - motion.begin) / 0.06))
        for key, value in zip(keys, [angle, load, *force, grip * load, slip, rim, torque, command]):
            out[key].append(round(value, 6))
    return {"name": name, "x_m": ahead, "y_m": left, **out}


def drive(policy, name, motion, grip, state="at rest", samples=None, bend=0.0):
    times = [round(k * STEP, 2) for k in range(samples or int(motion.duration / STEP) + 2)]
    rows = {key: [] for key in ["x_m", "y_m", "heading_deg", "v_x_mps", "v_y_mps", "yaw_rate_degps", "a_x_mps2", "a_y_mps2",
                                "steering_deg", "steering_command_deg", "motor_Nm", "motor_command_Nm"]}
    for t in times:
        x, y, heading, v_W, rate, a_W = motion.at(t)
        motor = -800.0 if motion.begin <= t < motion.begin + 0.3 else 0.0
        for key, value in zip(rows, [x, y, wrapped(math.degrees(heading)), *into(heading, v_W), math.degrees(rate), *into(heading, a_W),
                                     steering(motion, t - 0.05), steering(motion, t), 0.9 * motor, motor]):
            rows[key].append(round(value, 6))
    return {"schema": "saca.drive/1", "program": "saca 0.0.0", "command": f"SYNTHETIC TEST DATA, policy {policy}", "car": CAR,
            "policy": {"id": policy, "name": name, "target_speed_mps": None, "strength": None}, "road": {"lane_width_m": 3.5, "curvature_1pm": bend, "grip": grip},
            "start": {"speed_mps": motion.speed},
            "end": {"state": state, "time_s": times[-1], "forward_m": rows["x_m"][-1], "sideways_m": rows["y_m"][-1], "heading_deg": rows["heading_deg"][-1],
                    "speed_mps": math.hypot(rows["v_x_mps"][-1], rows["v_y_mps"][-1])},
            "time_s": times, **rows, "wheels": [wheel_samples(w, motion, grip, times) for w in WHEELS], "draws": None}


def percentiles(values):
    ordered = sorted(values)
    return {f"p{p:02d}": ordered[round(p / 100 * (len(ordered) - 1))] for p in (5, 50, 95)}


def wilson(hits, n):
    """95 % interval of a share (Wilson 1927)."""
    z, p = 1.96, hits / n
    middle, half = p + z * z / 2 / n, z * math.sqrt(p * (1 - p) / n + z * z / 4 / n / n)
    return {"share": p, "low": (middle - half) / (1 + z * z / n), "high": (middle + half) / (1 + z * z / n)}


def slide():
    """To the right, across the lane; the arc bends to the right, too."""
    return drive(6, "T-D-R", Motion(14.0, 7.2, -88.0, -0.012), 0.9)


def draws():
    record, chance, count = slide(), random.Random(1), 400
    paths, ends, times = [], [], []
    for n in range(count):
        motion = Motion(14.0 + chance.gauss(0, 0.15), 7.2 * (1 + chance.gauss(0, 0.04)), -88.0 + chance.gauss(0, 4.5), -0.012 + chance.gauss(0, 0.002))
        steps = [0.05 * k for k in range(int(motion.duration / 0.05) + 1)] + [motion.duration]
        poses = [motion.at(t)[:3] for t in steps]
        track = {"x_m": [p[0] for p in poses], "y_m": [p[1] for p in poses], "heading_deg": [wrapped(math.degrees(p[2])) for p in poses]}
        ends.append({key: values[-1] for key, values in track.items()})
        times.append(motion.duration)
        if n < 50:
            paths.append(track)
    record["draws"] = {
        "seed": 1, "count": count,
        "unknown": {"grip_sd": 0.06, "mass_sd": 0.03, "yaw_inertia_sd": 0.04, "stiffness_sd": 0.10, "lag_sd_s": 0.010, "speed_sd_mps": 0.15},
        "within_10_deg": wilson(sum(abs(e["heading_deg"] + 90) <= 10 for e in ends), count),
        "time_s": percentiles(times), "forward_m": percentiles(e["x_m"] for e in ends), "sideways_m": percentiles(e["y_m"] for e in ends),
        "heading_deg": percentiles(e["heading_deg"] for e in ends), "paths": paths, "ends": ends}
    return record


def braking():
    return drive(0, "AEB", Motion(20.0, 8.4), 0.9)


def bend():
    """Along a lane that bends to the left, not to rest."""
    record = drive(3, "ES-B-L", Motion(20.0, 4.0, 0.0, 0.012), 0.6, "still moving", 250, 0.012)
    record["policy"]["target_speed_mps"] = 10.0
    return record


def instant():
    return drive(7, "NI", Motion(14.0, 7.0), 0.9, "still moving", 1)


RECORDS = {"slide": slide, "draws": draws, "braking": braking, "bend": bend, "instant": instant}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in RECORDS:
        sys.exit(__doc__)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(RECORDS[sys.argv[1]](), file, allow_nan=False)
