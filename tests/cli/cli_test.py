"""The command line: stories, records, exit codes, and one clear error for each kind of bad input."""
import csv
import ctypes
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, PROGRAM, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, quick, saca


@pytest.fixture
def scenario(tmp_path):
    """A copy of a shipped scenario to spoil."""
    text = (ROOT / "scenarios/intersection_t1.toml").read_text()

    def spoilt(old, new):
        assert old in text
        file = tmp_path / "spoilt.toml"
        file.write_text(text.replace(old, new, 1))
        return file

    return spoilt


def test_tells_what_the_driver_did_what_saca_did_and_what_would_have_been_best(tmp_path):
    run = quick("100car_9018", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    for words in ("The driver: ", "looking out the left window", "The drive as recorded: clear by",
                  "SACA: 0 AEB", "Best in hindsight, kept to the end: ", "T2: car1", "(nearest: ",
                  "s to the conflict with car1"):
        assert words in run.stdout
    assert (tmp_path / "runs/100car_9018/report.html").exists()


@pytest.mark.parametrize("name", ["100car_8456", "100car_8676", "100car_8911", "100car_9018", "intersection_t1",
                                  "intersection_t2"])
def test_every_shipped_scenario_gives_a_record(name, tmp_path):
    run = quick(name, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    record = json.loads(run.stdout)
    assert record == json.loads((tmp_path / "runs" / name / "record.json").read_text())
    assert record["schema"] == "saca.record/1"
    assert record["scenario"]["name"] == name
    if record["decision"]:
        assert record["decision"]["policy"] in range(8)
        assert record["hindsight"][record["best"]]["harm"] <= record["result"]["harm"] + 1e-4


def test_the_same_run_gives_the_same_bytes_but_for_the_clock(tmp_path):
    def record(folder):
        (tmp_path / folder).mkdir()
        out = quick("100car_9018", "--json", cwd=tmp_path / folder).stdout
        made = json.loads(out)["made"]
        return made["content"], re.sub(r'"reflex_us_\w+": [0-9.e+-]+|"date": "[^"]*"', "", out)

    assert record("a") == record("b")


def test_memory_learns_and_is_shown(tmp_path):
    assert quick("100car_8676", cwd=tmp_path).returncode == SUCCESS
    assert not list(tmp_path.rglob("*.sqlite")), "memory is used where it is asked for"
    assert quick("100car_8676", "--memory", "runs/memory.sqlite", "--empty-memory", cwd=tmp_path).returncode == SUCCESS
    assert "want a folder that is there, got rnus" in one_error(quick("100car_8676", "--memory", "rnus/memory.sqlite", cwd=tmp_path), BAD_INPUT)
    assert not (tmp_path / "rnus").exists()
    cases = json.loads(saca("memory", "list", "--json", cwd=tmp_path).stdout)
    assert [case["source"] for case in cases] == ["100car_8676"]
    shown = json.loads(saca("memory", "show", 1, cwd=tmp_path).stdout)
    assert shown["scene"]["schema"] == "saca.scene/1"
    assert "want an id" in one_error(saca("memory", "show", 7, cwd=tmp_path), BAD_INPUT)


def test_a_trace_tells_every_frame_and_event(tmp_path):
    run = quick("100car_9018", "--trace", "a/trace.jsonl", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    record = json.loads(run.stdout)
    header, *lines = map(json.loads, (tmp_path / "a/trace.jsonl").read_text().splitlines())
    assert header["type"] == "header" and header["schema"] == "saca.trace/1"
    assert header["scenario"] == "100car_9018" and header["pace"] == "lockstep"
    assert header["actors"] == record["actors"] and header["road"] == record["road"]
    frames = [line for line in lines if line["type"] == "frame"]
    assert lines == frames + [line for line in lines if line["type"] == "event"]
    for key in ("t_s", "phase", "ego", "actors", "conflict_s"):
        assert [frame[key] for frame in frames] == [frame[key] for frame in record["frames"]]
    assert [{**event, "type": "event"} for event in record["events"]] == lines[len(frames):]
    times = [frame["t_s"] for frame in frames]
    assert max(after - before for before, after in zip(times, times[1:])) < 0.021


def test_a_trace_as_csv_tells_the_same_and_comes_out_the_same(tmp_path):
    for file in ("a.csv", "b.csv", "c.jsonl"):
        assert quick("100car_9018", "--trace", file, cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    header, *lines = map(json.loads, (tmp_path / "c.jsonl").read_text().splitlines())
    frames = [line for line in lines if line["type"] == "frame"]
    truth = [row for row in rows if row["perceived"] == "0"]
    assert len(truth) == sum(1 + len(frame["actors"]) for frame in frames)
    actors = iter(row for row in truth if row["id"] != "ego")
    for frame in frames:
        for actor in frame["actors"]:
            row = next(actors)
            assert row["id"] == actor["id"] and float(row["t_s"]) == frame["t_s"]
            for key in ("x_m", "y_m", "heading_deg", "speed_mps"):
                assert float(row[key]) == pytest.approx(actor[key], abs=1e-12)
    ego = next(row for row in truth if row["id"] == "ego")
    assert float(ego["length_m"]) == header["ego"]["length_m"]


@pytest.mark.parametrize("file", ["trace", "trace.json", "trace.mcap", "trace.CSV", ".csv"])
def test_a_trace_of_another_kind_is_refused(file, tmp_path):
    run = quick("100car_9018", "--trace", file, cwd=tmp_path)
    assert run.returncode == WRONG_COMMAND_LINE
    assert "--trace" in run.stderr and ".jsonl or .csv" in run.stderr and file in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_trace_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    run = quick("100car_9018", "--trace", "file/trace.csv", cwd=tmp_path)
    assert "file" in one_error(run, CANNOT_WRITE)


def test_a_policy_can_be_asked_for(tmp_path):
    record = json.loads(quick("intersection_t1", "--policy", 7, "--json", cwd=tmp_path).stdout)
    assert record["decision"]["policy"] == 7
    assert record["decision"]["source"] == "forced"
    assert record["result"]["contact"]["with"] == "truck1"


def test_before_a_close_follower_braking_fully_harms_and_what_is_decided_does_not(tmp_path):
    def record(*more):
        run = quick("100car_8456", "--json", *more, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
        return json.loads(run.stdout)

    braked, decided = record("--policy", 0), record()
    assert braked["result"]["contact"]["with"] == "car1" and braked["result"]["contact"]["ego_face"] == "rear"
    assert decided["decision"]["policy"] == 3 and decided["result"]["contact"] is None


def test_a_drift_stops_across_the_lane(tmp_path):
    record = json.loads(quick("100car_9018", "--policy", 5, "--json", cwd=tmp_path).stdout)
    assert record["decision"]["policy"] == 5
    last = record["frames"][-1]["ego"]
    assert last["speed_mps"] == 0
    assert abs(last["heading_deg"] - 90) < 10


def test_a_drift_on_a_slippery_road_is_refused_and_it_brakes(scenario, tmp_path):
    run = quick(scenario("grip = 0.9", "grip = 0.15"), "--policy", 6, cwd=tmp_path)
    assert run.returncode == SUCCESS
    assert "6 T-D-R cannot be driven" in run.stdout
    assert "policy 0 AEB (fallback)" in run.stdout


@pytest.mark.parametrize("arguments", [
    [], ["run"], ["fly"], ["run", "x", "--pace", "warp"], ["run", "x", "--policy", "9"],
    ["run", "x", "--policy", "0", "--strength", "0.1"], ["run", "x", "--policy", "left"], ["memory"], ["import", "100car"], ["import", "commonroad", "x.xml"], ["bench", "luck"],
    ["run", "x", "--no-such-flag"], ["vehicle"], ["vehicle", "fit"], ["vehicle", "fit", "x.csv"],
    ["vehicle", "test-drive", "fly", "--output", "x"], ["vehicle", "test-drive", "brake"],
    ["vehicle", "fit", "x.csv", "--car", "compact_rwd_ev", "--output", "y", "--grip", "9"]])
def test_a_wrong_command_line_is_told(arguments, tmp_path):
    run = saca(*arguments, cwd=tmp_path)
    assert run.returncode == WRONG_COMMAND_LINE
    assert run.stderr.strip()


@pytest.mark.parametrize("old, new, words", [
    ("speed_mps = 14", "speed_kmh = 50", "did you mean 'speed_mps'?"),
    ("grip = 0.9", "grip = nan", "grip: want"),
    ("grip = 0.9", "grip = 0.9\ncolour = 1", "colour: unknown key"),
    ("s_m = 6\nd_m = 4", "s_m = -70\nd_m = 0", "overlap|touch|covers"),
    ("duration_s = 13", 'duration_s = "long"', "duration_s: want a number, got a string"),
    ("[ego.start]", "[ego.start", "not TOML"),
    ('car = "compact_rwd_ev"', 'car = "batmobile"', "car: batmobile: no car is there"),
])
def test_a_spoilt_scenario_is_one_clear_error(old, new, words, scenario, tmp_path):
    file = scenario(old, new)
    message = one_error(quick(file, cwd=tmp_path), BAD_INPUT)
    assert re.search(words, message), message
    if "batmobile" not in words:
        assert re.search(r"spoilt\.toml:\d+", message), message
    assert not (tmp_path / "runs").exists() or not list((tmp_path / "runs").glob("*/record.json"))


def test_a_missing_scenario_is_named(tmp_path):
    assert "nowhere.toml" in one_error(quick("nowhere.toml", cwd=tmp_path), BAD_INPUT)
    assert "intersection_t1, " in one_error(quick("intersection", cwd=tmp_path), BAD_INPUT)  # is told what there is


@pytest.fixture
def release(tmp_path):
    """A tiny copy of the 100-Car release: some rows of event 8911."""
    return pathlib.Path(shutil.copytree(ROOT / "saca/lab/recordings/testdata", tmp_path / "release"))


def test_an_event_becomes_a_scenario_that_runs(release, tmp_path):
    run = saca("import", "100car", release, "--event", 8911, "--before-s", 2, "--output", "mine.toml",
               cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "event 8911" in run.stdout
    assert quick("mine.toml", cwd=tmp_path).returncode == SUCCESS


def test_an_event_file_with_missing_columns_is_refused(release, tmp_path):
    file = release / "timeseries/HundredCar_Public_8911.txt"
    lines = file.read_text().splitlines()
    lines[4] = ",".join(lines[4].split(",")[:70])
    file.write_text("\n".join(lines))
    message = one_error(saca("import", "100car", release, "--event", 8911, cwd=tmp_path), BAD_INPUT)
    assert "HundredCar_Public_8911.txt:5" in message and "79" in message and "70" in message


def test_an_event_that_is_not_there_is_named(release, tmp_path):
    assert "4711" in one_error(saca("import", "100car", release, "--event", 4711, cwd=tmp_path), BAD_INPUT)


SMALL = ROOT / "saca/lab/recordings/testdata/commonroad_small.xml"


def test_recorded_traffic_becomes_a_scenario_that_runs(tmp_path):
    run = saca("import", "commonroad", SMALL, "--output", "mine.toml", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "4 vehicles around the planning problem" in run.stdout
    assert "ignored: 1 shape/polygon" in run.stdout
    assert quick("mine.toml", cwd=tmp_path).returncode == SUCCESS


def test_the_ego_takes_a_recorded_vehicles_place(tmp_path):
    run = saca("import", "commonroad", SMALL, "--ego", 10, "--from-s", 0.1, "--output", "mine.toml", "--json",
               cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["ego"] == 10 and told["from_s"] == 0.1
    assert [actor["obstacle"] for actor in told["actors"]] == [11, 21, 20]
    assert quick("mine.toml", cwd=tmp_path).returncode == SUCCESS


def test_predictions_are_no_recordings(tmp_path):
    (tmp_path / "spot.xml").write_text(SMALL.read_text().replace("hand-made", "NGSIM (SPOT)"))
    message = one_error(saca("import", "commonroad", "spot.xml", "--output", "x.toml", cwd=tmp_path), BAD_INPUT)
    assert "spot.xml:4" in message and "SPOT" in message
    assert not (tmp_path / "x.toml").exists()


def test_a_damaged_memory_is_told_and_kept(tmp_path):
    file = tmp_path / "memory.sqlite"
    file.write_bytes(b"this is not a database, and never was one" * 100)
    before = file.read_bytes()
    message = one_error(quick("100car_8676", "--memory", file, cwd=tmp_path), BAD_INPUT)
    assert "memory.sqlite" in message
    assert file.read_bytes() == before


def obey_modes():
    """Root's right to write to any file is dropped for good."""
    drop_from_bounding_set, dac_override = 24, 1  # linux/prctl.h, linux/capability.h
    if os.geteuid() == 0 and ctypes.CDLL(None).prctl(drop_from_bounding_set, dac_override, 0, 0, 0) != 0:
        raise OSError("the capability cannot be dropped")


def test_a_memory_that_may_only_be_read_is_used_and_the_lost_case_told(tmp_path):
    quick("100car_8676", "--memory", "memory.sqlite", "--empty-memory", cwd=tmp_path)
    file = tmp_path / "memory.sqlite"
    file.chmod(0o444)
    before = file.read_bytes()
    run = quick("100car_8676", "--memory", "memory.sqlite", cwd=tmp_path, preexec_fn=obey_modes)
    assert "memory.sqlite" in one_error(run, CANNOT_WRITE)
    assert "report.html" in run.stdout  # which is complete
    assert file.read_bytes() == before
    record = json.loads((tmp_path / "runs/100car_8676/record.json").read_text())
    assert record["decision"]["source"] == "memory"  # it was read
    assert any(event["kind"] == "fault" and "memory.sqlite" in event["text"] for event in record["events"])


def test_a_full_disk_leaves_no_half_written_file(tmp_path):
    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    run = quick("100car_8676", cwd=tmp_path, preexec_fn=small_files)
    assert run.returncode == CANNOT_WRITE
    assert "record.json" in run.stderr
    assert list((tmp_path / "runs/100car_8676").iterdir()) == []


def test_without_a_model_it_runs_and_says_so(tmp_path):
    lonely = tmp_path / "bin/build/saca"
    lonely.parent.mkdir(parents=True)
    shutil.copy(PROGRAM, lonely)
    for folder in ("data", "scenarios", "models"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    run = subprocess.run([lonely, "run", "100car_8676", "--pace", "lockstep"], cwd=tmp_path,
                         capture_output=True, text=True, timeout=1500)
    assert run.returncode == SUCCESS, run.stderr
    assert "make model" in run.stderr and "--llm off" in run.stderr
    assert "language model: off" in run.stdout
    for command in (["reason", "100car_8676"], ["model", "bench"]):  # which are nothing without one
        error = one_error(subprocess.run([lonely, *command], cwd=tmp_path, capture_output=True, text=True, timeout=1500), BAD_INPUT)
        assert "make model" in error and "going on" not in error


@pytest.mark.parametrize("text, words", [
    ("{", "JSON"), ('{"schema": "other/1"}', "schema"), ("", "JSON")])
def test_a_damaged_replay_is_refused(text, words, tmp_path):
    file = tmp_path / "replies.json"
    file.write_text(text)
    message = one_error(saca("run", "100car_8676", "--llm", f"replay:{file}", cwd=tmp_path),
                        BAD_INPUT)
    assert "replies.json" in message and words.lower() in message.lower()
