"""`saca drive`, `saca physics` and `saca tune`."""
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

CARS = sorted(file.stem for file in (ROOT / "data/vehicles").glob("*.toml") if ".tuning" not in file.name)


@pytest.fixture
def car(tmp_path):
    """A copy of the default car and its tuning to spoil."""
    for kind in ("", ".tuning"):
        shutil.copy(ROOT / f"data/vehicles/compact_rwd_ev{kind}.toml", tmp_path / f"own{kind}.toml")
    return tmp_path / "own.toml"


def test_there_are_four_cars():
    assert CARS == ["compact_rwd_ev", "delivery_van", "midsize_suv", "small_fwd_car"]


@pytest.mark.parametrize("car_name", CARS)
def test_every_car_brakes_and_changes_lanes(car_name, tmp_path):
    stop = json.loads(saca("drive", "--policy", 0, "--speed", 20, "--car", car_name, "--json", cwd=tmp_path).stdout)
    assert stop["end"]["state"] == "at rest"
    # v^2 / (2 mu g) at grip 0.9 is the least; a tenth of a second and the deployed brake's share more.
    assert 22.7 < stop["end"]["forward_m"] < 1.25 * 22.7
    for policy, side in ((1, 1), (2, -1), (3, 1), (4, -1)):
        change = json.loads(saca("drive", "--policy", policy, "--speed", 15, "--car", car_name, "--json",
                                 cwd=tmp_path).stdout)
        assert change["end"]["state"] == "lane recovered"
        assert change["end"]["sideways_m"] == pytest.approx(3.5 * side, abs=0.25)


def test_a_drift_is_told_in_figures_and_shown(tmp_path):
    run = saca("drive", "--policy", 6, "--speed", 14, "--draws", 30, "--report", "out/drift.html", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "T-D-R from 14 m/s on grip 0.9 with compact_rwd_ev: at rest after" in run.stdout
    assert re.search(r"within 10 deg of across the lane: \d+\.\d % \(95 % interval", run.stdout)
    assert "saca.drive/1" in (tmp_path / "out/drift.html").read_text()


def test_sides_are_told_in_words(tmp_path):
    """Mirror images in the same figures; nothing is ever a negative distance to the left."""
    told = [saca("drive", "--policy", policy, "--speed", 15, cwd=tmp_path).stdout for policy in ("AES-L", "AES-R")]
    aside = [re.search(r"forward, (\d+\.\d\d) m to the (left|right); heading \d+\.\d deg", one).groups() for one in told]
    assert [side for _, side in aside] == ["left", "right"] and aside[0][0] == aside[1][0]
    braked = saca("drive", "--policy", 0, "--speed", 15, cwd=tmp_path).stdout
    assert "forward, 0.00 m; heading 0.0 deg, 0.0 m/s" in braked and "-" not in braked.splitlines()[1]


def test_the_record_is_physical(tmp_path):
    record = json.loads(saca("drive", "--policy", 4, "--speed", 17, "--grip", 0.6, "--target-speed", 8, "--json",
                             cwd=tmp_path).stdout)
    assert record["policy"] == {"id": 4, "name": "ES-B-R", "target_speed_mps": 8, "strength": None}
    weight = record["car"]["mass_kg"] * 9.80665
    for i, _ in enumerate(record["time_s"]):
        assert sum(wheel["load_N"][i] for wheel in record["wheels"]) == pytest.approx(weight, rel=1e-9)
        for wheel in record["wheels"]:
            force = (wheel["F_x_N"][i] ** 2 + wheel["F_y_N"][i] ** 2) ** 0.5
            assert force <= wheel["peak_N"][i] * (1 + 1e-9)
    assert record["end"]["speed_mps"] == pytest.approx(8, abs=1)


def test_braking_with_half_of_the_grip_takes_twice_the_way_less_the_build_up(tmp_path):
    def stop(*more):
        return json.loads(saca("drive", "--policy", 0, "--speed", 14, "--grip", 0.8, *more, "--json", cwd=tmp_path).stdout)

    half, full = stop("--strength", 0.5), stop()
    assert half["policy"] == {"id": 0, "name": "AEB", "target_speed_mps": None, "strength": 0.5}
    assert full["policy"]["strength"] is None and "--strength 0.5" in half["command"]
    build_up = 14 * 0.15  # [m], of both; at most
    assert 2 * (full["end"]["forward_m"] - build_up) < half["end"]["forward_m"] < 2 * full["end"]["forward_m"]
    assert stop("--strength", 1)["end"] == full["end"]


def test_same_seed_same_bytes_on_any_threads(tmp_path):
    def record(*more):
        return saca("drive", "--policy", 5, "--draws", 10, "--json", *more, cwd=tmp_path).stdout

    assert record("--threads", 1) == record("--threads", 2)
    assert record("--seed", 1) != record("--seed", 2)


@pytest.mark.parametrize("arguments, words", [
    (["--policy", 6, "--speed", 3], "T-D-R needs a speed of .* m/s ahead, is 3.00"),
    (["--policy", 1, "--strength", 0.5], "AES-L takes no strength"),
    (["--policy", 1, "--grip", 0.1], "AES-L needs a grip of 0.2 to 1.0, is 0.100"),
    (["--policy", 1, "--target-speed", 3], "AES-L takes no target speed"),
    (["--policy", 0, "--car", "batmobile"], "batmobile: no car is there"),
])
def test_what_cannot_be_driven_is_one_clear_error(arguments, words, tmp_path):
    assert re.search(words, one_error(saca("drive", *arguments, cwd=tmp_path), BAD_INPUT))


@pytest.mark.parametrize("arguments", [
    ["drive"], ["drive", "--policy", 8], ["drive", "--policy", 0, "--speed", "fast"],
    ["drive", "--policy", 0, "--draws", -1], ["drive", "--policy", 0, "--grip", 0], ["drive", "--policy", 0, "--strength", 0.1], ["physics", "--drift-draws", -1],
    ["tune", "--draws", 0]])
def test_a_wrong_command_line_is_told(arguments, tmp_path):
    run = saca(*arguments, cwd=tmp_path)
    assert run.returncode == WRONG_COMMAND_LINE
    assert run.stderr.strip()


@pytest.mark.parametrize("old, new, words", [
    ("mass_kg = 1700.0", "mass_kg = -1700.0", r"own\.toml:\d+: .*mass_kg: want"),
    ("track_width_m = 1.6", "track_width_m = 0", r"track_width_m: want"),
    ("rear_arm_m = 1.45", "rear_arm_m = -1.45", r"rear_arm_m: want"),
    ("front_inertia_kgm2 = 1.2", "front_inertia_kgm2 = 0.5", r"wheels: want wheels heavy enough"),
])
def test_what_is_no_car_is_refused(old, new, words, car, tmp_path):
    text = car.read_text()
    assert old in text
    car.write_text(text.replace(old, new))
    assert re.search(words, one_error(saca("drive", "--policy", 0, "--car", car, cwd=tmp_path), BAD_INPUT))


def test_a_car_without_tuning_says_what_makes_it(car, tmp_path):
    car.with_suffix(".tuning.toml").unlink()
    error = one_error(saca("drive", "--policy", 0, "--car", car, cwd=tmp_path), BAD_INPUT)
    assert f"saca tune --car {car}" in error


def test_a_report_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    error = one_error(saca("drive", "--policy", 0, "--report", "file/x.html", cwd=tmp_path), CANNOT_WRITE)
    assert "file" in error


def test_physics_stands_beside_its_reference(tmp_path):
    run = saca("physics", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "physics.aeb.stop_distance_m.v14.mu0.9" in run.stdout
    figures = json.loads(saca("physics", "--json", "--drift-draws", 2, "--car", "compact_rwd_ev", cwd=tmp_path).stdout)
    stop = "physics.aeb_ideal.stop_distance_m.v14.mu0.9"
    assert figures[stop] == pytest.approx(12.70, rel=0.05)
    assert figures[stop + ".reference"] == 12.7 and figures[stop + ".low"] < 12.7 < figures[stop + ".high"]
    assert 0 <= figures["t_drift.within_10_deg.share.compact_rwd_ev.v14.mu0.9"] <= 1
    assert figures["t_drift.refused.compact_rwd_ev.v10.mu1.0"] and figures["t_drift.n"] == 2 and figures["t_drift.seed"] == 1


TUNE = ["tune", "--car", "own.toml", "--swerve-evaluations", 12, "--drift-evaluations", 6, "--draws", 2]


@pytest.fixture(scope="module")
def tuned(tmp_path_factory):
    """A folder with a car that was tuned, by one thread, and what was told of it."""
    folder = tmp_path_factory.mktemp("tuned")
    for kind in ("", ".tuning"):
        shutil.copy(ROOT / f"data/vehicles/compact_rwd_ev{kind}.toml", folder / f"own{kind}.toml")
    return folder, saca(*TUNE, "--threads", 1, "--json", cwd=folder)


def test_tuning_gives_a_file_with_its_command_that_a_car_can_be_driven_with(tuned):
    folder, run = tuned
    assert run.returncode == SUCCESS, run.stderr
    text = (folder / "own.tuning.toml").read_text()
    assert text.startswith("# Made by: saca tune --car")
    assert json.loads(run.stdout)["drift_cost"] > 0
    assert saca("drive", "--policy", 1, "--car", "own.toml", cwd=folder).returncode == SUCCESS
    assert not list(folder.glob("*.journal"))


def test_tuning_that_was_interrupted_goes_on_and_ends_the_same(tuned, car, tmp_path):
    journal = tmp_path / "a.toml.swerve.journal"
    with subprocess.Popen([PROGRAM, *map(str, [*TUNE, "--output", "a.toml"])], cwd=tmp_path,
                          stderr=subprocess.PIPE, text=True) as first:
        deadline = time.monotonic() + 1500
        while time.monotonic() < deadline and not (journal.exists() and journal.read_text().count("\n") > 3):
            time.sleep(0.01)
        first.send_signal(signal.SIGINT)
        error = first.communicate(timeout=1500)[1]
    assert first.returncode == INTERRUPTED
    assert "The same command goes on" in error
    assert not (tmp_path / "a.toml").exists()
    assert saca(*TUNE, "--output", "a.toml", cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "a.toml").read_text() == (tuned[0] / "own.tuning.toml").read_text()


def test_a_journal_is_worth_nothing_once_the_car_has_changed(car, tmp_path):
    with subprocess.Popen([PROGRAM, *map(str, [*TUNE, "--output", "a.toml"])], cwd=tmp_path, stderr=subprocess.PIPE) as first:
        journal = tmp_path / "a.toml.swerve.journal"
        deadline = time.monotonic() + 1500
        while time.monotonic() < deadline and not (journal.exists() and journal.read_text().count("\n") > 1):
            time.sleep(0.01)
        first.send_signal(signal.SIGINT)
    car.write_text(car.read_text().replace("mass_kg = 1700.0", "mass_kg = 1750.0"))
    assert "remove it" in one_error(saca(*TUNE, "--output", "a.toml", cwd=tmp_path), BAD_INPUT)


def test_a_journal_of_another_tuning_is_refused(car, tmp_path):
    (tmp_path / "a.toml.swerve.journal").write_text("something else\n")
    error = one_error(saca(*TUNE, "--output", "a.toml", cwd=tmp_path), BAD_INPUT)
    assert "something else" in error and "remove it" in error
