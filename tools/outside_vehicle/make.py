#!/usr/bin/env python3
"""A second opinion on saca/onboard/vehicle: the models of commonroad-vehicle-models on the same drives.

    make.py reference         writes saca/onboard/vehicle/testdata/outside_*.csv
    make.py compare TRACES    prints what the test of saca/onboard/vehicle drove beside it, and draws
                              docs/outside-models.png
    make.py causes            changes one thing at a time in the outside models, to see what it does
Called by run.sh, which makes the Python environment.
"""
import argparse
import csv
import importlib.metadata
import pathlib
import sys

import cases
import models
from vehiclemodels.vehicle_parameters import setup_vehicle_parameters

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCES = ROOT / "saca" / "onboard" / "vehicle" / "testdata"
PARAMETERS = ("m", "I_z", "a", "b", "T_f", "T_r", "h_cg", "h_s", "R_w", "I_y_w", "m_s", "m_uf", "m_ur")
TYRE = ("p_cy1", "p_dy1", "p_ky1", "p_cx1", "p_dx1", "p_kx1")


def origin():
    version = importlib.metadata.version("commonroad-vehicle-models")
    return (f"commonroad-vehicle-models {version}, vehicle {models.VEHICLE} (BMW 320i); "
            "written by tools/outside_vehicle/run.sh reference")


def header(case):
    car = models.MODELS["mb"].parameters(case)
    values = [f"{name}={getattr(car, name):.9g}" for name in PARAMETERS]
    values += [f"{name}={getattr(car.tire, name):.9g}" for name in TYRE]
    return [
        origin(),
        f"{case.name}: {case.what}; from {case.speed:g} m/s",
        "steering (road wheels) is linear between rows, acceleration holds until the next row",
        "torque of all wheels = m * R_w * acceleration; braking: front share "
        f"{case.front_brake_share:g}, driving: rear axle",
        "models: " + "; ".join(f"{name}: {models.MODELS[name].__doc__.splitlines()[0]}"
                               for name in case.models),
        " ".join(values),
    ]


def write_reference(case):
    path = REFERENCES / f"outside_{case.name}.csv"
    names = ["t_s", "steering_rad", "acceleration_mps2"]
    table = [[t, case.angle(t), case.pull(t)] for t in case.times()]
    for name in case.models:
        model = models.MODELS[name]
        names += [f"{name}_{column}" for column in model.columns]
        for line, row in zip(table, models.run(model, case)):
            line += row
    with path.open("w", encoding="ascii", newline="\n") as out:
        out.writelines(f"# {line}\n" for line in header(case))
        out.write(",".join(names) + "\n")
        for row in table:
            # Nothing below a tenth of a micrometre, -radian, ... matters; -0 is 0.
            out.write(",".join(f"{round(value, 7) + 0.0:.5g}" for value in row) + "\n")
    print(f"{path.relative_to(ROOT)}: {len(table)} rows, {path.stat().st_size} bytes")


def write_tyre():
    """Their tyre alone: force over load for slip along and slip angle, upright."""
    from vehiclemodels.utils import tire_model
    tyre = setup_vehicle_parameters(models.VEHICLE).tire
    path, load = REFERENCES / "outside_tyre.csv", 3000.0
    with path.open("w", encoding="ascii", newline="\n") as out:
        out.write(f"# {origin()}\n# their tyre at {load:g} N, upright; slip > 0 brakes, slip angle > 0 "
                  "moves left; forces over load\nslip,slip_angle_rad,along,across\n")
        for slip in (0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0):
            for angle in (-0.2, -0.1, -0.05, -0.02, -0.01, 0.0, 0.01, 0.02, 0.05, 0.1, 0.2):
                along = tire_model.formula_longitudinal(slip, 0.0, load, tyre)
                across, friction = tire_model.formula_lateral(angle, 0.0, load, tyre)
                forces = (tire_model.formula_longitudinal_comb(slip, angle, along, tyre),
                          tire_model.formula_lateral_comb(slip, angle, 0.0, friction, load, across,
                                                          tyre))
                out.write(",".join(f"{v:.5g}" for v in (slip, angle, *(f / load for f in forces))))
                out.write("\n")
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes")


def read(path):
    with path.open(encoding="ascii") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        columns = {name: [] for name in rows.fieldnames}
        for row in rows:
            for name, value in row.items():
                columns[name].append(float(value))
    return columns


def apart(ours, theirs, of, model):
    """Largest distance of two columns over the drive."""
    return max(abs(a - b) for a, b in zip(ours[f"{model}_{of}"], theirs[f"{model}_{of}"]))


def print_table(traces):
    print("| drive | beside | yaw rate | lateral acceleration | speed | way to the side |")
    print("|---|---|---|---|---|---|")
    for case in cases.CASES:
        ours, theirs = (read(folder / f"outside_{case.name}.csv") for folder in (traces, REFERENCES))
        for model in case.models:
            peak = {of: max(map(abs, theirs[f"{model}_{of}"]))
                    for of in ("yaw_rate_radps", "ay_mps2")}
            cells = []
            for of, unit in (("yaw_rate_radps", "rad/s"), ("ay_mps2", "m/s2")):
                value = apart(ours, theirs, of, model)
                share = f" ({100.0 * value / peak[of]:.1f} %)" if peak[of] > 0.02 else ""
                cells.append(f"{value:.4f} {unit}{share}")
            cells.append(f"{apart(ours, theirs, 'speed_mps', model):.3f} m/s")
            cells.append(f"{apart(ours, theirs, 'y_m', model):.3f} m of "
                         f"{max(map(abs, theirs[f'{model}_y_m'])):.1f}")
            print(f"| `{case.name}` | {model} | " + " | ".join(cells) + " |")


def draw(traces, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    shown = (("corner_06g", "corner, 0.6 g"), ("step_large", "step steer, 0.75 g"),
             ("sine_with_dwell", "sine with dwell, 0.6 g"), ("brake_in_corner", "braking in a corner"),
             ("drift_entry", "rear wheels braked until they lock"))
    pyplot.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = pyplot.subplots(2, len(shown), figsize=(14.0, 5.2), layout="constrained")
    looks = {"std": ("single track, drift", "#1b7f79"), "mb": ("multi-body", "#b5532a")}
    for column, (name, title) in enumerate(shown):
        ours, theirs = (read(folder / f"outside_{name}.csv") for folder in (traces, REFERENCES))
        for model, (label, colour) in looks.items():
            for axis, (x, y) in zip(axes[:, column], (("t_s", f"{model}_yaw_rate_radps"),
                                                      (f"{model}_x_m", f"{model}_y_m"))):
                axis.plot(theirs[x], theirs[y], color=colour, linewidth=3.5, alpha=0.45,
                          label=f"{label} (outside)")
                axis.plot(ours[x], ours[y], color=colour, linewidth=1.1, linestyle="--",
                          label=f"SACA, set up as {label}")
        axes[0, column].set(title=title, xlabel="time [s]")
        axes[1, column].set(xlabel="x [m]")
    axes[0, 0].set_ylabel("yaw rate [rad/s]")
    axes[1, 0].set_ylabel("y [m]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes", file=sys.stderr)


def changed(kind, **factors):
    """A model of that kind with some of the car's parameters multiplied."""
    class Changed(kind):
        def parameters(self, case):
            car = super().parameters(case)
            for name, factor in factors.items():
                setattr(car, name, factor * getattr(car, name))
            return car
    return Changed()


class OurTyre(models.Plain):
    height = 0.61373004  # the package's h_s


def print_causes():
    yaw_rate = models.MOTION.index("yaw_rate_radps")

    def peak(model, name):
        case = next(case for case in cases.CASES if case.name == name)
        return max(abs(row[yaw_rate]) for row in models.run(model, case))

    print("| drive | model | change | largest yaw rate [rad/s] |")
    print("|---|---|---|---|")
    for name, model, what in (
            ("corner_02g", models.MultiBody(), "none"),
            ("corner_02g", models.Upright(), "no camber in the tyre"),
            ("brake_in_corner", models.Upright(), "no camber in the tyre"),
            ("brake_in_corner", changed(models.Upright, K_sdf=2.6, K_sdr=2.6),
             "and dampers 2.6 times as hard: no overshoot in pitch"),
            ("drift_entry", models.Drift(), "none"),
            ("drift_entry", changed(models.Drift, h_s=0.4),
             "load shift by 3.6 of the 9 m/s2 that are asked for: what the speed loses"),
            ("drift_entry", changed(OurTyre, h_s=0.4), "and our law of the tyre")):
        print(f"| `{name}` | {model.name} | {what} | {peak(model, name):.4f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("reference")
    commands.add_parser("compare").add_argument("traces", type=pathlib.Path)
    commands.add_parser("causes")
    arguments = parser.parse_args()
    if arguments.command == "reference":
        REFERENCES.mkdir(exist_ok=True)
        for case in cases.CASES:
            write_reference(case)
        write_tyre()
    elif arguments.command == "causes":
        print_causes()
    else:
        print_table(arguments.traces)
        draw(arguments.traces, ROOT / "docs" / "outside-models.png")


if __name__ == "__main__":
    main()
