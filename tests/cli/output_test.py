"""Standard output that is full, closed, or read by nobody: the encounter is played and recorded all the same."""
import json
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import CANNOT_WRITE, PROGRAM, SUCCESS, one_error, quick, saca


def test_a_full_standard_output_is_not_success(tmp_path):
    with open("/dev/full", "w") as full:
        for more in ([], ["--json"]):
            run = subprocess.run([PROGRAM, "run", "100car_8676", "--llm", "off", "--pace", "lockstep", *more],
                                 cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True, timeout=1500)
            assert run.returncode == CANNOT_WRITE, run.stderr
            assert run.stderr.strip()


@pytest.fixture
def unread():
    """The end to write to of a pipe that is full, and that nobody reads."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    with pytest.raises(BlockingIOError):
        while True:
            os.write(writer, bytes(4096))
    os.set_blocking(writer, True)
    yield writer
    os.close(reader)
    os.close(writer)


@pytest.fixture
def unheard():
    """The end to write to of a pipe whose reader has gone."""
    reader, writer = os.pipe()
    os.close(reader)
    yield writer
    os.close(writer)


def expect_the_record_of(name, folder):
    """The encounter was decided at the instant at which it is decided when everybody listens, and all of it was recorded."""
    usual = json.loads(quick(name, "--json", cwd=folder / "usual").stdout)
    record = json.loads((folder / "runs" / name / "record.json").read_text())
    assert record["decision"]["time_s"] == pytest.approx(usual["decision"]["time_s"], abs=0.011)
    kinds = [event["kind"] for event in record["events"]]
    assert all(kind in kinds for kind in ("preview", "trigger", "match", "execute", "rest"))
    assert (folder / "runs" / name / "report.html").exists()


def test_at_real_pace_nobody_need_read_the_story_for_the_car_to_brake(unread, tmp_path):
    (tmp_path / "usual").mkdir()
    run = subprocess.run([PROGRAM, "run", "one_way", "--llm", "off", "--pace", "real"], cwd=tmp_path,
                         stdout=unread, stderr=subprocess.PIPE, text=True, timeout=1500)
    assert "nobody has read it" in one_error(run, CANNOT_WRITE)
    expect_the_record_of("one_way", tmp_path)


@pytest.mark.parametrize("pace", ["real", "lockstep"])
def test_a_story_whose_reader_has_gone_is_told_and_the_encounter_played(pace, unheard, tmp_path):
    (tmp_path / "usual").mkdir()
    run = subprocess.run([PROGRAM, "run", "one_way", "--llm", "off", "--pace", pace], cwd=tmp_path,
                         stdout=unheard, stderr=subprocess.PIPE, text=True, timeout=1500)
    assert "standard output" in one_error(run, CANNOT_WRITE)
    expect_the_record_of("one_way", tmp_path)


@pytest.mark.parametrize("closed", [[1], [0, 1, 2]])
@pytest.mark.parametrize("more", [[], ["--json"]])
def test_with_closed_standard_files_nothing_else_is_written_to(closed, more, tmp_path):
    def close():
        for file in closed:
            os.close(file)

    (tmp_path / "usual").mkdir()
    (tmp_path / "runs").mkdir()
    run = subprocess.run([PROGRAM, "run", "one_way", "--llm", "off", "--pace", "lockstep", "--memory", "runs/memory.sqlite", *more],
                         cwd=tmp_path, stderr=subprocess.PIPE, preexec_fn=close, text=True, timeout=1500)
    assert run.returncode == CANNOT_WRITE
    expect_the_record_of("one_way", tmp_path)
    listed = saca("memory", "list", cwd=tmp_path)
    assert listed.returncode == SUCCESS and "one_way" in listed.stdout, listed.stderr
