"""`saca vehicle fit` and `saca vehicle test-drive`."""
import json
import pathlib
import re
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

CAR = ROOT / "data/vehicles/compact_rwd_ev.toml"


@pytest.fixture
def own_car(tmp_path):
    """Tests of somebody's own car, and the base to begin with."""
    text = CAR.read_text()
    truth = tmp_path / "truth.toml"
    truth.write_text(text.replace("lag_s = 0.06 ", "lag_s = 0.09 ", 1).replace("stiffness = 18.0", "stiffness = 21.0"))
    for kind, speed in ("brake", 12), ("steer", 20):
        run = saca("vehicle", "test-drive", kind, "--car", truth, "--speed-mps", speed, "--output",
                   tmp_path / f"{kind}.csv", cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
    shutil.copy(CAR, tmp_path / "base.toml")
    return tmp_path


def fit(*arguments, cwd, base="base.toml", output="mine.toml"):
    return saca("vehicle", "fit", *arguments, "--car", base, "--output", output, cwd=cwd)


def test_a_car_is_fitted_to_its_logs(own_car):
    run = fit("brake.csv", "steer.csv", "--json", cwd=own_car)
    assert run.returncode == SUCCESS, run.stderr
    report = json.loads(run.stdout)
    assert report["schema"] == "saca.vehicle_fit/1"
    found = {(one["section"], one["key"]): one for one in report["parameters"]}
    for key, truth in (("brakes", "lag_s"), 0.09), (("tyre", "stiffness"), 21.0):
        assert found[key]["low"] < truth < found[key]["high"]
        assert abs(found[key]["value"] - truth) < 0.1 * truth
    text = (own_car / "mine.toml").read_text()
    changed = [line for line in text.splitlines() if line not in CAR.read_text().splitlines()]
    assert all("fitted to brake.csv, steer.csv" in line for line in changed)
    assert len(changed) == sum(one["determined"] for one in report["parameters"]) - 1  # grip is the road's
    again = fit("brake.csv", base="mine.toml", output="again.toml", cwd=own_car)  # it can be read
    assert again.returncode == SUCCESS and "the logs do not determine it" in again.stdout


def test_a_fit_writes_over_its_base_only_by_force_and_over_a_log_never(own_car):
    before = (own_car / "base.toml").read_text()
    assert "--force" in one_error(fit("brake.csv", output="./base.toml", cwd=own_car), WRONG_COMMAND_LINE)
    told = one_error(saca("vehicle", "test-drive", "brake", "--car", "base.toml", "--output", "base.toml", cwd=own_car), WRONG_COMMAND_LINE)
    assert "--output: want another file than --car, got base.toml" in told
    assert "is a log" in one_error(fit("brake.csv", output="brake.csv", cwd=own_car), WRONG_COMMAND_LINE)
    assert (own_car / "base.toml").read_text() == before
    assert fit("brake.csv", "--force", output="base.toml", cwd=own_car).returncode == SUCCESS
    assert "fitted to brake.csv" in (own_car / "base.toml").read_text()


def test_a_fitted_car_that_cannot_be_written_leaves_nothing(own_car):
    assert "brake.csv/mine.toml" in one_error(fit("brake.csv", output="brake.csv/mine.toml", cwd=own_car), CANNOT_WRITE)


@pytest.mark.parametrize("spoil, words", [
    (lambda text: "", "an empty file"),
    (lambda text: text.splitlines()[0] + "\n", "only a line of names"),
    (lambda text: text.replace("speed_mps", "speed_kmh", 1), r"brake\.csv:1: unknown column `speed_kmh`"),
    (lambda text: text.replace("time_s,speed_mps", "speed_mps,time_s", 1), r"brake\.csv:\d+: time_s: want"),
    (lambda text: text.replace("\n0.03,", "\nnan,", 1), r"brake\.csv:5: time_s: want a finite number, got `nan`"),
    (lambda text: text.replace("\n0.03,", "\nsoon,", 1), r"brake\.csv:5: time_s: want a finite number, got `soon`"),
    (lambda text: text.replace("\n0.03,", "\n0.02,", 1), r"brake\.csv:5: time_s: want 0.0001"),
    (lambda text: "\n".join(text.splitlines()[:12]), "want at least 20 rows, got 11"),
    (lambda text: "\n".join(text.splitlines()[:45]), "got no braking"),
    (lambda text: "\n".join(",".join(line.split(",")[:-2]) for line in text.splitlines()), "other three wheels"),
])
def test_a_spoilt_log_is_one_clear_error(spoil, words, own_car):
    file = own_car / "brake.csv"
    file.write_text(spoil(file.read_text()))
    message = one_error(fit("brake.csv", cwd=own_car), BAD_INPUT)
    assert "brake.csv" in message and re.search(words, message), message
    assert not (own_car / "mine.toml").exists()


def test_a_missing_log_or_car_is_named(own_car):
    assert "no.csv" in one_error(fit("no.csv", cwd=own_car), BAD_INPUT)
    assert "batmobile" in one_error(fit("brake.csv", base="batmobile", cwd=own_car), BAD_INPUT)
