"""`saca explain`: why a run did what it did, every number of it true."""
import json
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, SUCCESS, one_error, saca

NUMBER = re.compile(r"(?<![\w.-])-?\d+(?:\.\d+)?(?![\w]|\.\d)")
ORDER = ["In short", "What threatened", "What was believed of the others", "What each plan was expected to end in",
         "Which plans were admissible", "What was chosen, and by which rule", "Why not the others", "What was switched",
         "How it ended", "What hindsight says"]


def numbers_of(value):
    """All numbers of a document, and those in its texts."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for one in value for number in numbers_of(one)]
    if isinstance(value, str):
        return [float(number) for number in NUMBER.findall(value)]
    return [] if value is None or isinstance(value, bool) else [float(value)]


def could_be_told(record):
    """Numbers of the record, without its thousands of poses; shares also in percent."""
    time = record["decision"]["time_s"]
    frame = [one for one in record["frames"] if one["t_s"] <= time][-1]
    told = {key: record[key] for key in ("thresholds", "decision", "switches", "events")}
    told["ends"] = [{key: one[key] for key in ("text", "harm", "target_speed_mps")} for one in record["hindsight"]]
    told["results"] = [{key: one[key] for key in ("text", "harm")} for one in (record["result"], record["driver"]) if one]
    numbers = numbers_of(told) + [frame["ego"]["speed_mps"], frame["conflict_s"], len(record["decision"]["verdict"]["plans"])]
    for seen in record["intentions"]:
        newest = [k for k, seen_at in enumerate(seen["times_s"]) if seen_at <= time][-1:]
        numbers += [seen["times_s"][k] for k in newest]
        numbers += [int(permille) / 10 for k in newest for permille in seen["now_permille"][k].split()]
    shares = [plan["contact"] for plan in record["decision"]["verdict"]["plans"] if plan["contact"] is not None]
    shares += [record["decision"]["similarity"] or 0.0]
    for verdict in record["verdicts"]["in_hand"]:
        plans = [plan for plan in verdict["plans"] + [verdict["under_way"]] if plan and plan["harm"] is not None]
        numbers += [verdict["t_s"]] + numbers_of([[plan["harm"], plan["target_speed_mps"]] for plan in plans])
        shares += [plan["contact"] for plan in plans]
    plans = [*record["decision"]["verdict"]["plans"], record["decision"], *record["switches"]]
    shares += [plan["strength"] for plan in plans if plan["strength"] is not None]
    return numbers + [100 * share for share in shares]


@pytest.fixture(scope="module", params=["100car_9018", "intersection_t1", "showcase_1"])
def record(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("explain")
    run = saca("run", request.param, "--llm", "off", "--pace", "lockstep", "--json", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    (folder / "record.json").write_text(run.stdout)
    return folder / "record.json"


def test_every_number_stands_in_the_record(record):
    run = saca("explain", record, cwd=record.parent)
    assert run.returncode == SUCCESS, run.stderr
    there = could_be_told(json.loads(record.read_text()))
    numbers = NUMBER.findall(run.stdout)
    assert len(numbers) > 30
    for number in numbers:
        half_a_digit = 0.5 * 10 ** -len(number.partition(".")[2])
        assert any(abs(float(number) - one) <= half_a_digit + 1e-9 for one in there), number


def test_tells_everything_in_order(record):
    told = json.loads(saca("explain", record, "--json", cwd=record.parent).stdout)
    assert told["schema"] == "saca.explanation/1"
    assert [paragraph["about"] for paragraph in told["paragraphs"]] == ORDER
    words = saca("explain", record, cwd=record.parent).stdout
    for paragraph in told["paragraphs"]:
        assert paragraph["sentences"]
        for sentence in paragraph["sentences"]:
            assert sentence in words and sentence.endswith((".", ". "))


def test_tells_each_plan_once_as_chosen_or_not(record):
    plans = json.loads(record.read_text())["decision"]["verdict"]["plans"]
    told = {one["about"]: one["sentences"]
            for one in json.loads(saca("explain", record, "--json", cwd=record.parent).stdout)["paragraphs"]}
    assert len(told["What each plan was expected to end in"]) == len(plans) + 1
    assert len(told["Why not the others"]) == len(plans) - 1


@pytest.mark.parametrize("text, wanted", [("", "want the JSON of a record"), ("[]", "want the JSON of a record"),
                                          ('{"schema": "saca.tape/1"}', 'schema: want "saca.record/1", got "saca.tape/1"'),
                                          ('{"schema": "saca.record/1"}', "'decision' not found")])
def test_what_is_no_record_is_refused_in_one_line(text, wanted, tmp_path):
    (tmp_path / "bad.json").write_text(text)
    error = one_error(saca("explain", "bad.json", cwd=tmp_path), BAD_INPUT)
    assert wanted in error and "bad.json" in error
    assert "none.json" in one_error(saca("explain", "none.json", cwd=tmp_path), BAD_INPUT)
