"""`saca atlas`, and the atlas of `saca run`."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, ROOT, WRONG_COMMAND_LINE, one_error, saca


def test_an_interrupted_build_goes_on_where_it_was(tmp_path):
    journal = tmp_path / "own.atlas.journal"

    def build_until(size):
        run = subprocess.Popen([PROGRAM, "atlas", "build", "--output", "own.atlas", "--threads", "1"], cwd=tmp_path,
                               stderr=subprocess.PIPE, text=True)
        while run.poll() is None and not (journal.exists() and journal.stat().st_size > size):
            time.sleep(0.001)
        run.send_signal(signal.SIGINT)
        _, told = run.communicate(timeout=1500)
        assert run.returncode == INTERRUPTED, told
        assert "the same command goes on" in told.lower()
        return journal.read_bytes()

    first = build_until(1000)
    again = build_until(len(first))
    assert not (tmp_path / "own.atlas").exists()
    assert again.startswith(first) and len(again) > len(first) > 1000
    # Nothing is driven twice.
    numbers = [line.split()[0] for line in again.decode().splitlines()[1:]]
    assert len(numbers) == len(set(numbers))


@pytest.mark.parametrize("text, wanted", [(b"", "cut short"), (b"x" * 50_000, "is no atlas")])
@pytest.mark.parametrize("command", [["atlas", "info"], ["atlas", "check"], ["run", "one_way", "--llm", "off", "--atlas"]])
def test_what_is_no_atlas_is_said_in_one_line(text, wanted, command, tmp_path):
    (tmp_path / "bad.atlas").write_bytes(text)
    error = one_error(saca(*command, "bad.atlas", cwd=tmp_path), BAD_INPUT)
    assert wanted in error and "bad.atlas" in error


def test_what_cannot_be_done_is_said(tmp_path):
    assert "none.atlas" in one_error(saca("atlas", "info", "none.atlas", cwd=tmp_path), BAD_INPUT)
    assert "batmobile" in one_error(saca("atlas", "build", "--car", "batmobile", cwd=tmp_path), BAD_INPUT)
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("atlas", "build", "--output", "file/a.atlas", cwd=tmp_path), CANNOT_WRITE)
    assert saca("atlas", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("atlas", "build", "--threads", 0, cwd=tmp_path).returncode == WRONG_COMMAND_LINE


def forecasts(run):
    """Which policies of the first preview were rolled out."""
    record = json.loads(run.stdout)
    assert record["previews"], "something was forecast"
    return record["atlas"], {fact["rolled_out"] for fact in record["previews"][0]["facts"] if fact["refusal"] is None}


def run(*arguments, cwd):
    return saca("run", "one_way", "--llm", "off", "--pace", "lockstep", "--json", *arguments, cwd=cwd)


def test_a_run_reads_its_forecasts_from_the_atlas(tmp_path):
    assert forecasts(run(cwd=tmp_path)) == (True, {False})
    assert forecasts(run("--atlas", "off", cwd=tmp_path)) == (False, {True})


def test_a_run_builds_the_atlas_where_there_is_none_that_is_right(tmp_path):
    program = tmp_path / "build" / "own" / "saca"
    program.parent.mkdir(parents=True)
    shutil.copy(PROGRAM, program)
    for folder in ["data", "scenarios", "models"]:
        shutil.copytree(ROOT / folder, tmp_path / folder)
    atlas = tmp_path / "cache" / "saca" / "atlases" / "compact_rwd_ev.atlas"

    def own_run():
        done = subprocess.run([program, "run", "one_way", "--llm", "off", "--pace", "lockstep", "--json"],
                              cwd=tmp_path, capture_output=True, text=True, check=True,
                              env=os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache")})
        assert forecasts(done) == (True, {False})
        return done.stderr

    own_run()
    assert not (tmp_path / "cache" / "saca" / "reach").exists(), "no run waits for a table of danger"
    built = atlas.read_bytes()
    stamp = atlas.stat().st_mtime_ns
    own_run()
    assert atlas.stat().st_mtime_ns == stamp
    car = tmp_path / "data" / "vehicles" / "compact_rwd_ev.toml"
    text = car.read_text()
    assert "stiffness = 18.0" in text
    car.write_text(text.replace("stiffness = 18.0", "stiffness = 18.5"))
    own_run()
    assert atlas.read_bytes() != built
    # Where it cannot be kept, it is used all the same.
    atlas.unlink()
    atlas.mkdir()
    (atlas / "in the way").write_text("")
    assert "built again next time" in own_run()


@pytest.fixture(scope="module")
def own_atlas(tmp_path_factory):
    """An atlas of the car that scenarios have."""
    folder = tmp_path_factory.mktemp("atlas")
    assert saca("atlas", "build", "--car", "compact_rwd_ev", "--output", "own.atlas", cwd=folder).returncode == 0
    return folder / "own.atlas"


def test_a_run_takes_the_atlas_that_it_is_told_and_no_other_cars(own_atlas, tmp_path):
    assert saca("atlas", "build", "--car", "midsize_suv", "--output", "midsize_suv.atlas", cwd=tmp_path).returncode == 0
    assert forecasts(run("--atlas", own_atlas, cwd=tmp_path)) == (True, {False})
    refused = one_error(run("--atlas", "midsize_suv.atlas", cwd=tmp_path), BAD_INPUT)
    assert "midsize_suv.atlas" in refused and "--atlas off" in refused
    # It is not built twice.
    before = (tmp_path / "midsize_suv.atlas").stat().st_mtime_ns
    again = saca("atlas", "build", "--car", "midsize_suv", "--output", "midsize_suv.atlas", cwd=tmp_path)
    assert "is there" in again.stdout and (tmp_path / "midsize_suv.atlas").stat().st_mtime_ns == before


def test_an_altered_atlas_is_refused(own_atlas, tmp_path):
    whole = own_atlas.read_bytes()
    for name, altered in {"cut.atlas": whole[:-1000], "flipped.atlas": whole[:500_000] + bytes([whole[500_000] ^ 1]) + whole[500_001:]}.items():
        (tmp_path / name).write_bytes(altered)
        assert name in one_error(run("--atlas", name, cwd=tmp_path), BAD_INPUT)


def test_a_package_is_one_file_of_one_car(own_atlas, tmp_path):
    made = saca("atlas", "package", own_atlas, "--output", "own.vehicle", cwd=tmp_path)
    assert made.returncode == 0 and "own.vehicle: compact_rwd_ev, " in made.stdout
    package = (tmp_path / "own.vehicle").read_bytes()
    assert package.startswith(b"SACAVPKG") and package.endswith(own_atlas.read_bytes()) and b"compact_rwd_ev" in package
    again = saca("atlas", "package", own_atlas, cwd=tmp_path)
    assert again.returncode == 0 and (tmp_path / "compact_rwd_ev.vehicle").read_bytes() == package, "same inputs, same bytes"


def test_a_package_needs_an_atlas_of_its_car(own_atlas, tmp_path):
    other = one_error(saca("atlas", "package", own_atlas, "--car", "midsize_suv", cwd=tmp_path), BAD_INPUT)
    assert "own.atlas: is of another car" in other and "saca atlas build --car midsize_suv" in other
    assert "none.atlas" in one_error(saca("atlas", "package", "none.atlas", cwd=tmp_path), BAD_INPUT)
    long_name = tmp_path / ("a" * 64 + ".toml")
    for ending in (".toml", ".tuning.toml"):
        shutil.copy(ROOT / f"data/vehicles/compact_rwd_ev{ending}", long_name.with_suffix(ending))
    told = one_error(saca("atlas", "package", own_atlas, "--car", long_name, cwd=tmp_path), BAD_INPUT)
    assert "want a car's name of at most 63 bytes, got 64" in told
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("atlas", "package", own_atlas, "--output", "file/a.vehicle", cwd=tmp_path), CANNOT_WRITE)
