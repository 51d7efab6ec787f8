"""The references of saca/onboard/vehicle/outside_test.cpp: where they come from, and that they belong together."""
import csv
import importlib.util
import pathlib
import re
import tomllib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "outside_vehicle"
TESTDATA = ROOT / "saca" / "onboard" / "vehicle" / "testdata"


def load_cases():
    spec = importlib.util.spec_from_file_location("outside_cases", TOOL / "cases.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {case.name: case for case in module.CASES}


CASES = load_cases()


def read(name):
    lines = (TESTDATA / f"outside_{name}.csv").read_text(encoding="ascii").splitlines()
    header = [line[2:] for line in lines if line.startswith("# ")]
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return header, [{key: float(value) for key, value in row.items()} for row in rows]


def test_there_is_one_reference_for_each_drive_and_one_for_the_tyre():
    assert {path.stem for path in TESTDATA.glob("outside_*.csv")} == {
        f"outside_{name}" for name in [*CASES, "tyre"]}


@pytest.mark.parametrize("name", [*CASES, "tyre"])
def test_a_reference_names_the_pinned_version_and_the_command(name):
    pinned = re.search(r"^commonroad-vehicle-models==(\S+) --hash=sha256:[0-9a-f]{64}$",
                       (TOOL / "requirements.txt").read_text(), re.MULTILINE).group(1)
    header, rows = read(name)
    assert header[0].startswith(f"commonroad-vehicle-models {pinned}, vehicle 2 ")
    assert header[0].endswith("written by tools/outside_vehicle/run.sh reference")
    assert rows


@pytest.mark.parametrize("name", CASES)
def test_a_reference_has_the_inputs_of_its_drive(name):
    case = CASES[name]
    _, rows = read(name)
    assert [row["t_s"] for row in rows] == pytest.approx(case.times(), abs=1e-9)
    for row, time in zip(rows, case.times()):
        assert row["steering_rad"] == pytest.approx(case.angle(time), rel=1e-4, abs=1e-7)
        assert row["acceleration_mps2"] == case.pull(time)
    for model in case.models:
        assert rows[0][f"{model}_speed_mps"] == pytest.approx(case.speed, abs=1e-3)


@pytest.mark.parametrize("name", CASES)
def test_our_car_is_theirs(name):
    header, _ = read(name)
    theirs = {key: float(value) for key, value in re.findall(r"(\w+)=(\S+)", header[-1])}
    car = tomllib.loads((TESTDATA / "outside_bmw_320i.toml").read_text())
    body, wheels, tyre = car["body"], car["wheels"], car["tyre"]
    for ours, of in ((body["mass_kg"], "m"), (body["yaw_inertia_kgm2"], "I_z"),
                     (body["front_arm_m"], "a"), (body["rear_arm_m"], "b"),
                     (body["mass_height_m"], "h_s"), (wheels["radius_m"], "R_w"),
                     (wheels["front_inertia_kgm2"], "I_y_w"), (wheels["rear_inertia_kgm2"], "I_y_w"),
                     (tyre["shape"], "p_cy1")):
        assert ours == pytest.approx(theirs[of], rel=1e-8), of
    assert body["track_width_m"] == pytest.approx(0.5 * (theirs["T_f"] + theirs["T_r"]), rel=1e-6)
    assert tyre["stiffness"] == -theirs["p_ky1"]
