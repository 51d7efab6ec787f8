"""What a record says of itself: who made it by what, its page made again, and whether it is as it was written."""
import json
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, NOT_THE_SAME, ROOT, SUCCESS, one_error, quick, saca


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """Of a copy of a shipped scenario, whose file may be changed."""
    folder = tmp_path_factory.mktemp("record")
    (folder / "mine.toml").write_text((ROOT / "scenarios/intersection_t1.toml").read_text())
    run = quick("mine.toml", "--seed", 3, "--report", "first page.html", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return folder, run.stdout


def record_of(folder):
    return next((folder / "runs").rglob("record.json"))


def test_a_record_says_who_made_it_by_what(played):
    made = json.loads(record_of(played[0]).read_text())["made"]
    assert made["program"].startswith("saca ") and made["seed"] == 3
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", made["date"])
    assert made["command"] == "saca run mine.toml --seed 3 --report 'first page.html' --llm off --pace lockstep"
    assert [one["what"] for one in made["inputs"]] == ["scenario", "car", "harm", "intentions", "atlas", "cues"]
    assert all(re.fullmatch(r"[0-9a-f]{16}", one["digest"]) for one in made["inputs"])


def test_its_page_can_be_made_again(played):
    folder, _ = played
    run = saca("report", record_of(folder), "--output", "again/page.html", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    assert (folder / "again/page.html").read_bytes() == (folder / "first page.html").read_bytes()
    assert saca("report", record_of(folder), cwd=folder).returncode == SUCCESS
    assert record_of(folder).with_name("report.html").exists()


def test_what_was_written_is_verified_and_what_was_changed_told(played):
    folder, _ = played
    run = saca("verify", record_of(folder), cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    assert run.stdout.count("the same here") == 6 and "content      as it was written" in run.stdout
    record = json.loads(record_of(folder).read_text())
    record["result"]["harm"] += 0.001
    (folder / "changed.json").write_text(json.dumps(record))
    run = saca("verify", "changed.json", cwd=folder)
    assert run.returncode == NOT_THE_SAME and "has been changed since" in run.stdout


def test_an_input_that_is_another_one_now_is_told(played):
    folder, _ = played
    scenario = folder / "mine.toml"
    text = scenario.read_text()
    try:
        scenario.write_text(text + "# another\n")
        told = saca("verify", record_of(folder), "--json", cwd=folder)
        scenario.unlink()
        missing = saca("verify", record_of(folder), cwd=folder)
    finally:
        scenario.write_text(text)
    assert told.returncode == missing.returncode == NOT_THE_SAME
    answer = json.loads(told.stdout)
    assert answer["schema"] == "saca.verification/1" and not answer["same"]
    assert {one["what"]: one["same"] for one in answer["inputs"]} == {
        "scenario": False, "car": True, "harm": True, "intentions": True, "atlas": True, "cues": True}
    assert "scenario     mine.toml: not here: " in missing.stdout


def test_what_is_no_record_or_cannot_be_written_is_refused(played, tmp_path):
    folder, _ = played
    (tmp_path / "none.json").write_text('{"schema": "saca.record/1"}')
    (tmp_path / "other.json").write_text('{"schema": "saca.drive/1"}')
    old = json.loads(record_of(folder).read_text())
    del old["made"]
    (tmp_path / "old.json").write_text(json.dumps(old))
    half = json.loads(record_of(folder).read_text())
    del half["made"]["inputs"]
    (tmp_path / "half.json").write_text(json.dumps(half))
    for file, words in (("none.json", "want a whole record"), ("other.json", 'want "saca.record/1"'), ("missing.json", "missing.json"),
                        ("old.json", "made: want who made the record"), ("half.json", "made: want it whole")):
        assert words in one_error(saca("verify", file, cwd=tmp_path), BAD_INPUT)
    assert "other.json" in one_error(saca("report", "other.json", cwd=tmp_path), BAD_INPUT)
    for file, (key, value) in {"frames.json": (("frames",), "no"), "policy.json": (("decision", "policy"), 99),
                               "trigger.json": (("thresholds", "trigger_s"), "soon")}.items():
        wrong = json.loads(record_of(folder).read_text())
        (wrong if len(key) == 1 else wrong[key[0]])[key[-1]] = value
        (tmp_path / file).write_text(json.dumps(wrong))
    for file in ("none.json", "frames.json", "policy.json", "trigger.json"):
        refusals = {one_error(saca(command, file, cwd=tmp_path), BAD_INPUT) for command in ("report", "explain")}
        assert len(refusals) == 1 and file in refusals.pop()
    assert not list(tmp_path.glob("*.html"))
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("report", record_of(folder), "--output", "file/page.html", cwd=tmp_path), CANNOT_WRITE)


def test_a_drive_ends_in_plain_sentences(played):
    """What was about to happen, what was weighed, why this was done; all abbreviations stand at the beginning."""
    folder, told = played
    sentences = json.loads(saca("explain", record_of(folder), "--json", cwd=folder).stdout)["paragraphs"][0]["sentences"]
    assert len(sentences) == 3 and all(sentence in told for sentence in sentences)
    assert re.match(r"At \d+\.\d\d s a conflict with truck1 came near, 1\.\d\d s away", sentences[0])
    assert "Had nothing been done, this would have come of it: hits truck1 with its" in sentences[0]
    assert re.match(r"Considered were \d+ plans\.", sentences[1]) and "was begun because" in sentences[2]
    begin = told[:told.index("s  world")]
    for short in ("T1", "T2", "AEB", "ES-B-L", "T-D-L", "NI", "FB"):
        assert short in begin


@pytest.mark.parametrize("name", ["showcase_5", "showcase_7_a", "one_way"])
def test_what_was_done_is_called_the_best_only_where_it_is(name, tmp_path):
    """A drive that hit somebody is never clear, and never the same as a best that did not."""
    run = quick(name, cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    record = json.loads(record_of(tmp_path).read_text())
    line = next(line for line in run.stdout.splitlines() if line.startswith("SACA: "))
    best = next(line for line in run.stdout.splitlines() if line.startswith("Best in hindsight"))
    more = record["result"]["harm"] - record["hindsight"][record["best"]]["harm"]
    assert ("hits" in line or "leaves" in line) == bool(record["result"]["contact"])
    assert all(f"from {change['t_s']:.2f} s on" in line for change in record["switches"])
    if more > 1e-3:
        assert f"It harms {more:.4f} less" in best
    elif abs(more) < 5e-4:
        same = not record["switches"] and record["best"] == record["decision"]["policy"]
        assert ("That is what was done." if same else "It harms as much as what was done.") in best
