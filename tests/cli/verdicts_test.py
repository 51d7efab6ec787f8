"""The verdicts over time in a record: those of the tape of the same run, and the hypotheses that they were made by."""
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import SUCCESS, saca

RUNS = {"a swerve in place of braking": ("showcase_7_a", "--pace", "lockstep"), "the wheel given back": ("intersection_t1", "--pace", "lockstep"),
        "at real pace": ("intersection_t1", "--pace", "real")}


@pytest.fixture(scope="module", params=RUNS.values(), ids=RUNS.keys())
def played(request, tmp_path_factory):
    """The record of a run, and the steps of its tape."""
    folder = tmp_path_factory.mktemp("verdicts")
    run = saca("run", *request.param, "--llm", "off", "--danger", "off", "--tape", "a.tape", "--json", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return json.loads(run.stdout), [as_in_records(one) for one in map(json.loads, (folder / "a.tape").read_text().splitlines()) if one["type"] == "step"]


def as_in_records(value):
    """A tape's numbers come back to the last bit, a record's have twelve digits."""
    if isinstance(value, dict):
        return {key: as_in_records(one) for key, one in value.items()}
    if isinstance(value, list):
        return [as_in_records(one) for one in value]
    return (0.0 if abs(value) < 1e-12 else float(f"{value:.12g}")) if isinstance(value, float) else value


def until_its_encounter_is_over(record, steps):
    """The record tells of the encounter of its decision; at real pace one more verdict may come after that."""
    over = [step["scene"]["time_s"] for step in steps if step["forgotten"] == "encounter" and step["scene"]["time_s"] > record["decision"]["time_s"]]
    return [step for step in steps if not over or step["scene"]["time_s"] < over[0]]


def numbers(judged):
    """What a record and a tape tell of one judged plan, in the record's words."""
    if judged is None:
        return None
    plan = judged.get("plan", judged)
    able = judged.get("drivable", judged["harm"] is not None)
    return plan["policy"], plan["target_speed_mps"], judged["harm"] if able else None, judged["contact"] if able else None


def test_they_are_those_of_the_tape(played):
    record, steps = played
    taped = {step["scene"]["time_s"]: step for step in until_its_encounter_is_over(record, steps) if step["verdict"]}
    told = [one for one in record["verdicts"]["in_hand"] if not one["by_atlas"]]
    assert len(told) + record["verdicts"]["left_out"] == len(taped) > 5 and len(record["verdicts"]["in_hand"]) <= 240
    assert [one["received_s"] for one in told] == sorted({one["received_s"] for one in told})
    for one in told:
        step = taped[one["received_s"]]
        assert one["t_s"] == step["verdict"]["t_s"]
        assert [numbers(plan) for plan in one["plans"]] == [numbers(plan) for plan in step["verdict"]["plans"]]
        if step["verdict"]["under_way"]:
            assert numbers(one["under_way"]) == numbers(step["verdict"]["under_way"])
    own = [one for one in record["verdicts"]["in_hand"] if one["by_atlas"]]
    assert len(own) == sum(bool(step["decision"] and step["decision"]["by_atlas"]) for step in steps)


def test_what_was_under_way_is_what_had_been_begun(played):
    record, _ = played
    begun = [(one["time_s" if one is record["decision"] else "t_s"], one["policy"]) for one in [record["decision"], *record["switches"]]]
    for one in record["verdicts"]["in_hand"]:
        before = [policy for time, policy in begun if time < one["t_s"]]
        assert (one["under_way"] and one["under_way"]["policy"]) == (before[-1] if before else None)


def test_the_admissible_set_is_that_of_its_definition(played):
    for one in played[0]["verdicts"]["in_hand"]:
        harms = [plan["harm"] for plan in one["plans"] if plan["harm"] is not None]
        braking = next(plan["harm"] for plan in one["plans"] if plan["policy"] == 0)
        assert one["admissible_harm"] == pytest.approx(min(harms) + max(0.002, 0.03 * (braking - min(harms))), rel=1e-9)


def test_hypotheses_begin_where_the_others_were_perceived(played):
    record, steps = played
    assert [one["t_s"] for one in record["hypotheses"]] == [record["decision"]["time_s"]] + [one["t_s"] for one in record["switches"]]
    for given in record["hypotheses"]:
        step = next(one for one in steps if one["scene"] and one["scene"]["time_s"] == given["scene_s"])
        seen = {f"{actor['kind']}{actor['id']}": actor for actor in step["scene"]["actors"]}
        assert sum(motion["probability"] for motion in given["motions"]) == pytest.approx(1.0, abs=1e-9)
        for motion in given["motions"]:
            assert {path["id"] for path in motion["paths"]} | set(given["reacting"]) == set(seen)
            for path in motion["paths"]:
                x, y, heading = (path[key].split() for key in ("x_cm", "y_cm", "heading_deg"))
                assert len(x) == len(y) == len(heading) <= 1 + given["horizon_s"] / given["step_s"]
                # Errors are of the spread that is perceived: of 16 strata the outermost lies 1.9 standard deviations away, along and across.
                actor = seen[path["id"]]
                off = ((float(x[0]) / 100 - actor["x_m"]) ** 2 + (float(y[0]) / 100 - actor["y_m"]) ** 2) ** 0.5
                assert off <= 2**0.5 * 1.9 * actor["position_sd_m"] + 0.01


def test_a_switch_was_made_by_the_newest_verdict(played):
    record, _ = played
    for change in record["switches"]:
        newest = [one for one in record["verdicts"]["in_hand"] if one["received_s"] <= change["t_s"] and not one["by_atlas"]][-1]
        if change["reason"] == "better by far":
            assert change["harm_before"] == newest["under_way"]["harm"]
            assert change["harm"] == min(plan["harm"] for plan in newest["plans"] if plan["harm"] is not None)
            assert change["harm_before"] - change["harm"] >= record["thresholds"]["material_harm"]
        elif change["reason"] == "no longer needed":
            nothing = next(plan for plan in newest["plans"] if plan["policy"] == 7)
            assert nothing["harm"] == nothing["contact"] == 0.0
