"""The models of commonroad-vehicle-models behind one interface.

Positive steering turns towards positive y in all of them and in ours, so nothing is mirrored here;
the multi-body model counts z downwards, which no column shows.
"""
import contextlib
import math
import unittest.mock

import numpy as np
from vehiclemodels.init_mb import init_mb
from vehiclemodels.init_std import init_std
from vehiclemodels.utils import tire_model
from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb
from vehiclemodels.vehicle_dynamics_st import vehicle_dynamics_st
from vehiclemodels.vehicle_dynamics_std import vehicle_dynamics_std
from vehiclemodels.vehicle_parameters import setup_vehicle_parameters

VEHICLE = 2  # BMW 320i
STEP = 5e-4  # [s], Runge-Kutta of fourth order
MOTION = ("x_m", "y_m", "yaw_rad", "speed_mps", "sideslip_rad", "yaw_rate_radps", "ay_mps2")
WHEELS = ("front_radps", "rear_radps")


@contextlib.contextmanager
def our_tyre(tyre):
    """Gives the package the law of saca/onboard/vehicle/tyre.h: one curve for both directions."""
    def force(slip, angle, load):
        sliding = math.hypot(slip * math.cos(angle), math.sin(angle))
        if sliding < 1e-12:
            return 0.0, 0.0
        steepness = -tyre.p_ky1 / (tyre.p_cy1 * tyre.p_dy1)
        size = load * tyre.p_dy1 * math.sin(tyre.p_cy1 * math.atan(steepness * sliding))
        return (-size * slip * math.cos(angle) / sliding, -size * math.sin(angle) / sliding)

    replaced = {  # "pure" slip hands on what the combined formulas below need
        "formula_longitudinal": lambda slip, camber, load, _: load,
        "formula_lateral": lambda angle, camber, load, _: (0.0, 0.0),
        "formula_longitudinal_comb": lambda slip, angle, load, _: force(slip, angle, load)[0],
        "formula_lateral_comb": lambda slip, angle, camber, friction, load, pure, _:
            force(slip, angle, load)[1],
    }
    with unittest.mock.patch.multiple(tire_model, **replaced):
        yield


class SingleTrack:
    """Linear single track: no limit of the tyres' force, speed as commanded."""
    name = "st"
    columns = MOTION
    wheels = slice(0, 0)  # where their speeds stand in the state
    dynamics = staticmethod(vehicle_dynamics_st)

    def parameters(self, case):
        car = setup_vehicle_parameters(VEHICLE)
        car.T_sb = case.front_brake_share
        return car

    def begin(self, speed, car):
        return [0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0]

    def row(self, x, rate):
        speed, sideslip = x[3], x[6]
        lateral = rate[3] * math.sin(sideslip) + speed * math.cos(sideslip) * (rate[6] + x[5])
        return [x[0], x[1], x[4], speed, sideslip, x[5], lateral]


class Drift(SingleTrack):
    """Single track with the magic formula, combined slip and one wheel for each axle."""
    name = "std"
    columns = MOTION + WHEELS
    wheels = slice(7, 9)
    dynamics = staticmethod(vehicle_dynamics_std)

    def begin(self, speed, car):
        return init_std(super().begin(speed, car), car)

    def row(self, x, rate):
        return super().row(x, rate) + [x[7], x[8]]


class Plain(Drift):
    """The drift model with our law of the tyre and its mass 1 cm above the road: no load shift."""
    name = "std_plain"
    height = 0.01  # [m]

    def parameters(self, case):
        car = super().parameters(case)
        car.h_s = self.height
        return car

    @staticmethod
    def dynamics(x, inputs, car):
        with our_tyre(car.tire):
            return vehicle_dynamics_std(x, inputs, car)


class MultiBody(SingleTrack):
    """Sprung mass on two axles: roll, pitch, heave, compliance, camber, four wheels."""
    name = "mb"
    columns = MOTION + WHEELS
    wheels = slice(23, 27)
    dynamics = staticmethod(vehicle_dynamics_mb)

    def begin(self, speed, car):
        # What the package begins with is 2 cm off its springs' rest: let them find it first.
        x = np.array(init_mb(super().begin(speed, car), car))
        for _ in range(round(4.0 / STEP)):
            x = runge_kutta(self, x, (0.0, 0.0), car, STEP)
        x[[0, 1, 4]] = 0.0
        return x

    def row(self, x, rate):
        lateral = rate[10] + x[5] * x[3]
        return [x[0], x[1], x[4], math.hypot(x[3], x[10]), math.atan2(x[10], x[3]), x[5], lateral,
                0.5 * (x[23] + x[24]), 0.5 * (x[25] + x[26])]


class Upright(MultiBody):
    """The multi-body model with a tyre that does not feel camber.

    The package's side force jumps by 2 % of the load where camber changes its sign, so its
    multi-body car trembles when it drives straight.
    """
    name = "mb_upright"

    def parameters(self, case):
        car = super().parameters(case)
        for name in ("p_dx3", "p_dy3", "p_hy1", "p_hy3", "p_vy1", "p_vy3", "r_vy3"):
            setattr(car.tire, name, 0.0)
        return car


MODELS = {model.name: model for model in (SingleTrack(), Drift(), Plain(), MultiBody(), Upright())}


def derivative(model, x, inputs, car):
    return np.array(model.dynamics(list(map(float, x)), inputs, car))


def runge_kutta(model, x, inputs, car, step):
    k1 = derivative(model, x, inputs, car)
    k2 = derivative(model, x + 0.5 * step * k1, inputs, car)
    k3 = derivative(model, x + 0.5 * step * k2, inputs, car)
    k4 = derivative(model, x + step * k3, inputs, car)
    end = x + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    # The package holds a wheel that turned backwards for ever; what it means is one at rest.
    end[model.wheels] = np.maximum(0.0, end[model.wheels])
    return end


def run(model, case, step=STEP):
    """The rows of one case, one for each of its times."""
    car = model.parameters(case)
    x = np.array(model.begin(case.speed, car), dtype=float)
    rows = []
    for inputs in case.inputs():
        rows.append(model.row(x, derivative(model, x, inputs, car)))
        for _ in range(round(case.row_time / step)):
            x = runge_kutta(model, x, inputs, car, step)
    return rows
