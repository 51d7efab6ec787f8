"""`saca run --tape` and `saca replay`: what was decided by is worked out again, bit by bit."""
import json
import math
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, NOT_THE_SAME, ROOT, SUCCESS, one_error, saca


def taped(folder, *options):
    """The tape of a run without model and memory."""
    run = saca("run", *options, "--llm", "off", "--tape", "a.tape", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return (folder / "a.tape").read_text()


@pytest.fixture(scope="module")
def tape(tmp_path_factory):
    return taped(tmp_path_factory.mktemp("tape"), "one_way", "--pace", "lockstep")


def digest(text):
    """FNV-1a, 64 bits, as its authors publish it."""
    value = 14695981039346656037
    for byte in text.encode():
        value = (value ^ byte) * 1099511628211 % 2**64
    return f"{value:016x}"


def altered(tape, alter):
    """The tape's objects after `alter` had them, with the digest that goes with them."""
    lines = [json.loads(line) for line in tape.splitlines()]
    alter(lines)
    text = "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines[:-1])
    return text + json.dumps({**lines[-1], "steps": len(lines) - 3, "digest": digest(text)}) + "\n"


def replayed(text, folder, *options):
    (folder / "b.tape").write_text(text)
    return saca("replay", "b.tape", *options, cwd=folder)


def counts(result):
    return {key: (result[key]["same"], result[key]["recorded"])
            for key in ("verdicts", "decisions", "switches", "answers", "beliefs")}


@pytest.mark.parametrize("options", [("100car_9018", "--pace", "lockstep", "--seed", "7"), ("intersection_t1", "--pace", "real")])
def test_everything_comes_back_to_the_last_bit(options, tmp_path):
    text = taped(tmp_path, *options)
    run = replayed(text, tmp_path, "--json")
    assert run.returncode == SUCCESS, run.stdout + run.stderr
    result = json.loads(run.stdout)
    assert result["first_difference"] is None
    assert result["steps_dropped"] == result["steps_lost"] == 0
    assert result["verdicts_not_compared"] == result["beliefs_not_compared"] == 0
    assert all(same == recorded for same, recorded in counts(result).values())
    steps = [json.loads(line) for line in text.splitlines()[2:-1]]
    assert result["beliefs"]["recorded"] == len(steps)
    assert result["verdicts"]["recorded"] == sum(step["verdict"] is not None for step in steps) > 0
    assert result["decisions"]["recorded"] == sum(step["decision"] is not None for step in steps) == 1
    assert result["switches"]["recorded"] == sum(step["reflex"]["switched"] is not None for step in steps)


def test_a_plan_of_memory_comes_from_the_tape(tmp_path):
    for _ in range(2):  # the second time memory knows the case
        run = saca("run", "intersection_t1", "--llm", "off", "--pace", "lockstep", "--memory", "m.sqlite", "--tape", "a.tape", cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
    (tmp_path / "m.sqlite").unlink()
    text = (tmp_path / "a.tape").read_text()
    decision = next(step["decision"] for step in map(json.loads, text.splitlines()) if step.get("decision"))
    assert decision["source"] == "memory" and decision["similarity"] > 0.9
    assert replayed(text, tmp_path).returncode == SUCCESS

    def forget(lines):
        for step in lines[2:-1]:
            step["plans"] = None

    run = replayed(altered(text, forget), tmp_path)
    assert run.returncode == NOT_THE_SAME and "decision" in run.stdout


def test_what_it_finds_is_told_in_words(tape, tmp_path):
    told = replayed(tape, tmp_path).stdout
    assert "one_way" in told and "choices at a trigger                    1 of      1" in told
    assert "difference" not in told


def test_the_tape_is_that_of_the_run(tape):
    header, *steps = [json.loads(line) for line in tape.splitlines()]
    assert (header["schema"], header["scenario"], header["pace"]) == ("saca.tape/6", "one_way", "lockstep")
    assert digest(tape[:tape.rindex("\n", 0, -1) + 1]) == steps[-1]["digest"]


def test_one_bit_of_a_scene_that_was_judged_is_noticed(tape, tmp_path):
    def alter(lines):
        judged = next(line["verdict"]["scene"] for line in lines if line.get("verdict") and line["type"] == "step")
        ego = next(line for line in lines if line.get("number") == judged)["scene"]["ego"]
        ego["forward_mps"] = math.nextafter(ego["forward_mps"], math.inf)

    run = replayed(altered(tape, alter), tmp_path, "--json")
    assert run.returncode == NOT_THE_SAME, run.stdout + run.stderr
    result = json.loads(run.stdout)
    assert result["first_difference"]["recorded"] != result["first_difference"]["got"]
    assert any(same < recorded for same, recorded in counts(result).values())


def test_another_choice_is_named_with_time_and_what_came(tape, tmp_path):
    time = None

    def alter(lines):
        nonlocal time
        step = next(line for line in lines if line.get("decision"))
        time = step["scene"]["time_s"]
        step["decision"]["source"] = "memory"

    text = altered(tape, alter)
    run = replayed(text, tmp_path)
    assert run.returncode == NOT_THE_SAME
    assert f'decision.source was "memory", and is "arbiter" now' in run.stdout
    assert f"The first difference is at {time}" in run.stdout
    result = json.loads(replayed(text, tmp_path, "--json").stdout)
    assert result["decisions"] == {"recorded": 1, "same": 0}
    assert result["first_difference"]["t_s"] == time


def without(key):
    return lambda lines: lines[0].pop(key)


def setting(key, value):
    return lambda lines: lines[0].update({key: value})


@pytest.mark.parametrize("alter, wanted", [
    (setting("schema", "saca.tape/9"), 'b.tape:1: schema: want saca.tape/6, got "saca.tape/9"'),
    (setting("program", "9.9.9"), "b.tape: program: recorded with 9.9.9, here it is"),
    (setting("level", "none"), "b.tape: level: recorded with none"),
    (setting("car", "batmobile"), "b.tape: car: "),
    (setting("car", "midsize_suv"), "b.tape: car_digest: recorded with"),
    (setting("intent_digest", "0"), "b.tape: intent_digest: recorded with 0, here it is"),
    (setting("harm_digest", "0"), "b.tape: harm_digest: recorded with 0"),
    (setting("atlas_digest", "0"), "b.tape: atlas_digest: recorded with 0"),
    (without("seed"), "b.tape:1: seed: is missing"),
    (lambda lines: lines.pop(1), 'b.tape:2: type: want "before"'),
    (lambda lines: lines[4].update(number=0), "b.tape:5: number: want more than 1, got 0"),
    (lambda lines: lines[5]["scene"]["ego"].pop("x_m"), "b.tape:6: scene: ego.x_m: is missing"),
    (lambda lines: lines[5].update(extra=1), "b.tape:6: extra: is not known"),
])
def test_what_cannot_be_replayed_is_refused_in_one_line(alter, wanted, tape, tmp_path):
    assert wanted in one_error(replayed(altered(tape, alter), tmp_path), BAD_INPUT)


def test_a_damaged_or_cut_tape_is_refused_in_one_line(tape, tmp_path):
    assert "cut short" in one_error(replayed(tape[:tape.rindex("\n", 0, -1) + 1], tmp_path), BAD_INPUT)
    for share in (0, 0.1, 0.5, 0.9):
        assert "b.tape" in one_error(replayed(tape[:int(share * len(tape))], tmp_path), BAD_INPUT)
    step = tape.index('"grip":')
    assert "altered" in one_error(replayed(tape[:step] + tape[step:].replace("0.", "0.1", 1), tmp_path), BAD_INPUT)
    assert "none.tape" in one_error(saca("replay", "none.tape", cwd=tmp_path), BAD_INPUT)
    scenario = ROOT / "scenarios/100car_9018.toml"
    assert "want one JSON object of a tape" in one_error(saca("replay", scenario, cwd=tmp_path), BAD_INPUT)


def test_a_tape_that_cannot_be_written_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    run = saca("run", "one_way", "--llm", "off", "--pace", "lockstep", "--tape", "file/a.tape", cwd=tmp_path)
    assert "file" in one_error(run, CANNOT_WRITE)
