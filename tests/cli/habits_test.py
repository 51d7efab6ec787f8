"""What a shell's user is used to: outputs are looked at before the work, one place for caches, exit codes that tell, quiet, colours, numbers."""
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import (BAD_INPUT, CANNOT_WRITE, NOTHING_TO_DECIDE, PROGRAM, ROOT, SUCCESS, TOO_SLOW, WRONG_COMMAND_LINE, figures, one_error,
                     quick, saca)


@pytest.mark.parametrize("arguments", [
    ("run", "one_way", "--llm", "off", "--no-memory", "--report"), ("run", "one_way", "--llm", "off", "--no-memory", "--tape"),
    ("oracle", "one_way", "--draws", 1_000_000, "--svg"), ("suite", "balanced", "--count", 10_000_000, "--output"),
    ("whatif", "intersection_t1", "--vary", "ego.speed_mps=8:18:0.06", "--vary", "truck.distance_m=10:20:0.06", "--svg"),
    ("ladder", "balanced", "--count", 10_000_000, "--output"), ("forecast", "eval", "balanced", "--count", 10_000_000, "--output"),
    ("tune", "--car", "midsize_suv", "--output"), ("reach", "solve", "truck", "--output"), ("reach", "check", "--grids", 5, "--picture"),
    ("drive", "--policy", 6, "--draws", 1_000_000, "--report"), ("family", "crossing", "--sample", 400, "--svg"),
    ("suite", "fmvss127", "--output"), ("atlas", "build", "--car", "midsize_suv", "--output"),
    ("search-showcase", "--count", 10_000_000, "--output"), ("intent", "examples", "none.h5", "--output"),
])
def test_an_output_that_cannot_be_is_told_before_the_work(arguments, tmp_path):
    (tmp_path / "file").write_text("what was there")
    ending = ".html" if "--report" in arguments or "fmvss127" in arguments else ".svg"
    begin = time.monotonic()
    run = saca(*arguments, f"file/below{ending}", cwd=tmp_path)
    assert "file" in one_error(run, CANNOT_WRITE)
    assert time.monotonic() - begin < 30  # hours of work, most of them
    assert (tmp_path / "file").read_text() == "what was there" and sorted(path.name for path in tmp_path.iterdir()) == ["file"]


SMALL = ROOT / "saca/lab/recordings/testdata/commonroad_small.xml"


@pytest.mark.parametrize("arguments, words", [
    (("run", "s.toml", "--report", "s.toml"), "--report: want another file than the scenario, got s.toml"),
    (("run", "s.toml", "--report", "runs/../runs/intersection_t1/record.json"), "--report: want another file than the record"),
    (("run", "s.toml", "--tape", "one.csv", "--trace", "one.csv"), "--tape: want another file than --trace, got one.csv"),
    (("run", "s.toml", "--memory", "m.sqlite", "--tape", "m.sqlite"), "--tape: want another file than --memory, got m.sqlite"),
    (("report", "r.json", "-o", "link.json"), "--output: want another file than the record, got link.json"),
    (("report", "report.html"), "--output: want another file than the record, got report.html"),
    (("import", "commonroad", "small.xml", "--output", "small.xml"), "--output: want another file than the recording, got small.xml"),
    (("oracle", "s.toml", "--svg", "s.toml"), "--svg: want another file than the scenario, got s.toml"),
    (("whatif", "s.toml", "--vary", "grip=0.5:0.9:0.4", "--svg", "s.toml"), "--svg: want another file than the scenario, got s.toml"),
    (("learn", "balanced", "--memory", "m.sqlite", "--svg", "m.sqlite"), "--svg: want another file than --memory, got m.sqlite"),
    (("learn", "balanced", "-o", "way", "--svg", "way/episodes.journal"), "--svg: want another file than the journal"),
    (("family", "f.toml", "--svg", "f.toml"), "--svg: want another file than the family, got f.toml"),
    (("drive", "--policy", 0, "--car", "car.toml", "--report", "car.toml"), "--report: want another file than --car, got car.toml"),
    (("atlas", "build", "--car", "car.toml", "--output", "car.toml"), "--output: want another file than --car, got car.toml"),
    (("atlas", "package", "a.atlas", "--output", "a.atlas"), "--output: want another file than the atlas, got a.atlas"),
    (("cases", "build", ".", "-o", "c.jsonl", "--for-memory", "c.jsonl"), "--for-memory: want another file than --output, got c.jsonl"),
])
def test_no_output_is_written_over_an_input_or_another_output(arguments, words, tmp_path):
    (tmp_path / "s.toml").write_text((ROOT / "scenarios/intersection_t1.toml").read_text())
    (tmp_path / "small.xml").write_text(SMALL.read_text())
    for ending in ("toml", "tuning.toml"):
        (tmp_path / f"car.{ending}").write_text((ROOT / f"data/vehicles/compact_rwd_ev.{ending}").read_text())
    (tmp_path / "f.toml").write_text((ROOT / "scenarios/families/crossing.toml").read_text())
    for record in ("r.json", "report.html"):
        (tmp_path / record).write_text("a record")
    (tmp_path / "link.json").symlink_to("r.json")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert words in one_error(saca(*arguments, cwd=tmp_path), WRONG_COMMAND_LINE)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize("arguments", [
    ("suite", "balanced", "--seed", "-1"), ("suite", "balanced", "--seed", "99999999999999999999999"), ("run", "one_way", "--seed", "-1"),
    ("memory", "thin", "--most", "-5"), ("import", "commonroad", SMALL, "--output", "a.toml", "--ego", "99999999999999999999"),
    ("forecast", "show", "head_on", "--who", "van1", "--at-s", "4", "-o", "a.svg", "--encounter", "-1"), ("oracle", "one_way", "--seed", "0x10"),
    ("suite", "balanced", "--replay", "1.5"), ("memory", "show", "010"),
])
def test_a_whole_number_that_does_not_fit_is_refused_and_not_changed(arguments, tmp_path):
    assert "want a whole number, " in one_error(saca(*arguments, cwd=tmp_path), WRONG_COMMAND_LINE)
    assert list(tmp_path.iterdir()) == []


def test_no_option_is_passed_over_silently(tmp_path):
    told = one_error(saca("run", "one_way", "--llm", "off", "--review", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "--review: want a language model" in told
    told = one_error(saca("physics", "--car", "nosuch", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "--car" in told and "--drift-draws" in told


def test_an_output_takes_the_folders_that_it_needs(tmp_path):
    for arguments in (("drive", "--policy", 0, "--report", "a/b/drive.html"), ("harm", "--svg", "c/harm.svg"),
                      ("vehicle", "test-drive", "brake", "--output", "d/e/brake.csv")):
        assert saca(*arguments, cwd=tmp_path).returncode == SUCCESS
        assert (tmp_path / arguments[-1]).stat().st_size > 0


@pytest.mark.parametrize("arguments", [
    ("run", "one_way", "--llm", "off", "--pace", "lockstep", "--no-learning"), ("memory", "list"), ("memory", "show", 1),
    ("suite", "balanced", "--count", 2)])
def test_who_only_reads_a_memory_makes_no_folder_for_it(arguments, tmp_path):
    place = ("--memory", "nowhere/memory.sqlite")
    arguments = ("memory", *place, *arguments[1:]) if arguments[0] == "memory" else (*arguments, *place)
    assert "nowhere/memory.sqlite: there is no such memory bank" in one_error(saca(*arguments, cwd=tmp_path), BAD_INPUT)
    assert not (tmp_path / "nowhere").exists()


def test_all_that_is_kept_lies_in_one_place(tmp_path):
    home = {**os.environ, "HOME": str(tmp_path / "home"), "XDG_CACHE_HOME": ""}
    arguments = ("run", "one_way", "--llm", "off", "--pace", "lockstep", "--no-memory", "--danger", "off", "--json")
    for before, environment, place in (
            (("--cache", "mine"), home, "mine"), ((), home, "home/.cache/saca"),
            ((), {**home, "XDG_CACHE_HOME": str(tmp_path / "xdg")}, "xdg/saca")):
        assert saca(*before, *arguments, cwd=tmp_path, env=environment).returncode == SUCCESS
        assert (tmp_path / place / "atlases/compact_rwd_ev.atlas").exists(), place
    assert "stands before the command" in saca(*arguments, "--cache", "late", cwd=tmp_path).stderr
    kept = sorted(path for path in tmp_path.rglob("*.atlas"))
    assert len(kept) == 3 and not (tmp_path / "late").exists()
    info = saca("--cache", "mine", "atlas", "info", cwd=tmp_path)
    assert info.returncode == SUCCESS, info.stderr


def test_nothing_to_decide_is_no_wrong_input(tmp_path):
    for arguments in (("oracle", "lead_drives_on_follower"), ("whatif", "lead_drives_on_follower", "--vary", "grip=0.5:0.9:0.4")):
        message = one_error(saca(*arguments, cwd=tmp_path), NOTHING_TO_DECIDE)
        assert "nothing is to be decided; say when with --at-s" in message
        assert list(tmp_path.iterdir()) == []
        assert saca(*arguments, "--at-s", 3, cwd=tmp_path).returncode == SUCCESS


def test_a_model_that_is_too_slow_is_no_wrong_input(tmp_path):
    replies = tmp_path / "replies.json"
    run = saca("reason", "intersection_t1", "--llm", f"replay:{replies}", cwd=tmp_path)
    assert run.returncode == BAD_INPUT  # there is none
    # That too_slow is what a late answer gets: reason_test, test_what_cannot_be_asked_is_refused.
    assert TOO_SLOW not in (SUCCESS, BAD_INPUT, CANNOT_WRITE, NOTHING_TO_DECIDE)


def exit_codes_of(text):
    return {int(code) for code in re.findall(r"^\| (\d+) \|", text, re.M)}


def test_the_table_of_exit_codes_has_all_of_them():
    formats = (ROOT / "docs/formats.md").read_text()
    table = formats.partition("## Exit codes of `saca`")[2]
    source = (ROOT / "apps/saca/command.h").read_text()
    declared = {int(code) for code in re.findall(r"^  \w+ = (\d+),", source.partition("enum ExitCode")[2].partition("};")[0], re.M)}
    assert exit_codes_of(table) == declared and {SUCCESS, NOTHING_TO_DECIDE, TOO_SLOW} <= declared


def test_quiet_leaves_errors_and_what_was_asked_for(tmp_path):
    few = ("suite", "crossing", "--count", 2, "--methods", "aeb", "--output")
    usual = saca(*few, "a.h5", cwd=tmp_path)
    still = saca("--quiet", *few, "b.h5", cwd=tmp_path)
    assert usual.returncode == still.returncode == SUCCESS
    assert "2 of at most 2" in usual.stderr and still.stderr == ""
    assert "regret" in still.stdout  # the table is what was asked for
    run = saca("--quiet", "run", "one_way", "--llm", "off", "--pace", "lockstep", "--no-memory", cwd=tmp_path)
    assert (run.returncode, run.stdout, run.stderr) == (SUCCESS, "", "")
    assert (tmp_path / "runs/one_way/report.html").exists()
    assert figures(saca("--quiet", "drive", "--policy", 0, "--json", cwd=tmp_path))["schema"] == "saca.drive/1"
    one_error(saca("--quiet", "drive", "--policy", 9, cwd=tmp_path), 2)


def on_a_terminal(*arguments, cwd, **environment):
    """What a terminal gets."""
    mine, its = pty.openpty()
    variables = {key: value for key, value in os.environ.items() if key != "NO_COLOR"} | environment
    run = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=cwd, stdout=its, stderr=its, env=variables)
    os.close(its)
    told = b""
    while True:
        try:
            piece = os.read(mine, 65536)
        except OSError:  # nobody writes any more
            break
        if not piece:
            break
        told += piece
    os.close(mine)
    assert run.wait(1500) == SUCCESS, told
    return told.decode()


def test_colours_are_for_terminals_that_want_them(tmp_path):
    arguments = ("run", "one_way", "--llm", "off", "--pace", "lockstep", "--no-memory", "--danger", "off")
    assert "\x1b[" in on_a_terminal(*arguments, cwd=tmp_path)
    assert "\x1b[" not in on_a_terminal(*arguments, cwd=tmp_path, NO_COLOR="1")
    assert "\x1b[" in on_a_terminal(*arguments, cwd=tmp_path, NO_COLOR="")  # https://no-color.org: not an empty one
    assert "\x1b[" not in saca(*arguments, cwd=tmp_path).stdout


def numbers_in(text):
    return re.findall(r"(?<![\w\".])-?\d+\.\d+(?:e[-+]?\d+)?(?![\w\"])", text)


def digits_of(number):
    return number.lower().partition("e")[0].replace(".", "").replace("-", "").strip("0")


@pytest.mark.parametrize("arguments", [
    ("oracle", "showcase_3", "--draws", 20), ("whatif", "intersection_t1", "--at-s", 5, "--vary", "grip=0.1:0.9:0.1"),
    ("physics",), ("harm",), ("atlas", "info"), ("family", "crossing", "--sample", 5), ("suite", "crossing", "--count", 3, "--methods", "saca,aeb"),
    ("suite", "r152", "--methods", "aeb"), ("balance", "--count", 5), ("forecast", "eval", "crossing", "--count", 3),
])
def test_numbers_are_as_a_person_would_write_them(arguments, tmp_path):
    run = saca(*arguments, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    json.loads(run.stdout)
    numbers = numbers_in(run.stdout)
    assert len(numbers) > 5
    # The JSON library does not always find the shortest text: one in a thousand numbers of twelve digits is printed with 17.
    long = [number for number in numbers if len(digits_of(number)) > 12]
    assert len(long) <= max(1, len(numbers) / 200) and all(float(number) == float(f"{float(number):.12g}") for number in long), long
    assert not [number for number in numbers if 0 < abs(float(number)) < 1e-12]
