"""`saca memory`."""
import gzip
import json
import pathlib
import sqlite3
import sys
import xml.etree.ElementTree as ElementTree

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, SUCCESS, WRONG_COMMAND_LINE, figures, one_error, saca

COUNT = 6


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """Of the first encounters of a suite, as JSON Lines."""
    folder = tmp_path_factory.mktemp("cases")
    run = saca("memory", "build", "balanced", "--count", str(COUNT), "--draws", "4", "--output", "cases.jsonl", "--json", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["memory.num_encounters"] == COUNT and told["memory.num_failed"] == 0
    lines = (folder / "cases.jsonl").read_text().splitlines()
    assert len(lines) == told["memory.num_cases"] + 1 > COUNT + 1, "twins among them"
    return folder / "cases.jsonl"


def documents(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_case_tells_what_was_told_and_what_happened(cases):
    header, *found = documents(cases)
    assert header == {"schema": "saca.cases/1", "cases": len(found)}
    for one in found:
        details = one["details"]
        assert len(details["told"]) == len(details["happened"]) == 8
        driven = [harm for harm in details["happened"] if harm is not None]
        assert one["best_harm"] == details["happened"][one["best_policy"]] <= min(driven) + 0.005
        assert details["happened"][0] is not None, "full braking can always be driven"
        assert len(details["intentions"]) == len(one["scene"]["actors"])
        for posterior in details["intentions"]:
            assert sum(posterior) == pytest.approx(1.0)


def test_building_goes_on_where_it_was_interrupted(cases, tmp_path):
    journal = cases.parent / "cases.jsonl.journal"
    lines = journal.read_text().splitlines(keepends=True)
    (tmp_path / "again.jsonl.journal").write_text("".join(lines[:3]) + lines[3][:50])  # killed while it wrote
    run = saca("memory", "build", "balanced", "--count", str(COUNT), "--draws", "4", "--output", "again.jsonl", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert (tmp_path / "again.jsonl").read_bytes() == cases.read_bytes()
    assert "--draws 4" in one_error(
        saca("memory", "build", "balanced", "--count", str(COUNT), "--draws", "5", "--output", "again.jsonl", cwd=tmp_path), BAD_INPUT)


def test_cases_go_in_and_come_out_without_loss(cases, tmp_path):
    assert saca("memory", "--memory", "bank.db", "import", str(cases), "--keep-trust", cwd=tmp_path).returncode == SUCCESS
    assert saca("memory", "--memory", "bank.db", "export", "out.jsonl", cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "out.jsonl").read_bytes() == cases.read_bytes()
    shown = saca("memory", "--memory", "bank.db", "show", "1", cwd=tmp_path)
    assert json.loads(shown.stdout) == documents(cases)[1]


def test_a_case_is_drawn_with_those_most_like_it(cases, tmp_path):
    saca("memory", "import", str(cases), "--memory", "bank.db", cwd=tmp_path)
    run = saca("memory", "show", "2", "--svg", "out/case.svg", "--memory", "bank.db", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    picture = ElementTree.parse(tmp_path / "out/case.svg").getroot()
    texts = ["".join(text.itertext()) for text in picture.iter("{http://www.w3.org/2000/svg}text")]
    assert sum(text.startswith("differs: ") or text == "the same scene" for text in texts) == 5
    assert any(text.startswith("expected: ") for text in texts) and any(text.startswith("in hindsight: ") for text in texts)
    assert "bank.db" in one_error(saca("memory", "show", "2", "--svg", "bank.db/case.svg", "--memory", "bank.db", cwd=tmp_path), CANNOT_WRITE)


def test_an_expert_adds_what_is_then_found_and_looked_at(tmp_path):
    added = saca("memory", "add", "intersection_t1", "--policy", "ES-B-R", "--why", "the truck is slow", "--memory", "bank.db", cwd=tmp_path)
    assert added.returncode == SUCCESS and "case 1; it is used where a rollout confirms it" in added.stdout, added.stderr
    case = json.loads(saca("memory", "show", "1", "--memory", "bank.db", cwd=tmp_path).stdout)
    assert case["best_policy"] == 4 and case["review"] == "the truck is slow" and case["source"] == "intersection_t1"
    assert case["details"] == {"origin": "expert", "trust": "unchecked"}
    run = saca("run", "intersection_t1", "--llm", "off", "--pace", "lockstep", "--danger", "off", "--no-learning", "--json", "--memory", "bank.db", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    found = [one["memory"] for one in json.loads(run.stdout)["previews"] if one["memory"]]
    assert found and all(one["case"] == 1 and one["gate"] != "cache" for one in found), "it is asked, and never believed unchecked"
    again = saca("memory", "add", "intersection_t1", "--policy", "4", "--memory", "bank.db", cwd=tmp_path)
    assert "case 1 stands for it already" in again.stdout
    other = saca("memory", "add", "intersection_t1", "--policy", "0", "--memory", "bank.db", cwd=tmp_path)
    assert "case 2, which contradicts case 1" in other.stdout


def test_a_case_is_added_to_the_bank_that_stands_before_the_command(tmp_path):
    added = figures(saca("memory", "--memory", "bank.db", "add", "intersection_t1", "--policy", "4", "--json", cwd=tmp_path))
    assert added == {"schema": "saca.memory_addition/1", "file": "bank.db", "id": 1, "added": True, "contradicts": None}
    assert [one["id"] for one in figures(saca("memory", "list", "--memory", "bank.db", "--json", cwd=tmp_path))] == [1]
    assert not (tmp_path / "runs").exists()
    again = figures(saca("memory", "add", "intersection_t1", "--policy", "4", "--memory", "bank.db", "--json", cwd=tmp_path))
    assert (again["id"], again["added"]) == (1, False)
    other = figures(saca("memory", "add", "intersection_t1", "--policy", "0", "--memory", "bank.db", "--json", cwd=tmp_path))
    assert (other["id"], other["added"], other["contradicts"]) == (2, True, 1)


def test_what_is_drawn_or_written_is_not_written_over_the_bank(cases, tmp_path):
    saca("memory", "import", str(cases), "--memory", "bank.db", cwd=tmp_path)
    before = (tmp_path / "bank.db").read_bytes()
    for arguments in (("export", "bank.db"), ("export", "./bank.db"), ("show", 1, "--svg", "bank.db"), ("show", 1, "--html", tmp_path / "bank.db")):
        told = one_error(saca("memory", *arguments, "--memory", "bank.db", cwd=tmp_path), WRONG_COMMAND_LINE)
        assert "want another file than --memory, got" in told and "bank.db" in told
    told = one_error(saca("memory", "show", 1, "--svg", "a", "--html", "b/../a", "--memory", "bank.db", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "--html: want another file than --svg" in told
    assert (tmp_path / "bank.db").read_bytes() == before


def test_what_cannot_be_added_is_told(tmp_path):
    assert "intersection" in one_error(saca("memory", "add", "intersectoin_t1", "--policy", "4", cwd=tmp_path), BAD_INPUT)
    assert saca("memory", "add", "intersection_t1", "--policy", "9", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("memory", "add", "intersection_t1", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert "--at-s" in one_error(saca("memory", "add", "intersection_t1", "--policy", "4", "--at-s", "100", cwd=tmp_path), BAD_INPUT)
    assert not (tmp_path / "runs").exists()


def test_what_comes_from_elsewhere_is_not_trusted(cases, tmp_path):
    run = saca("memory", "--memory", "bank.db", "import", str(cases), cwd=tmp_path)
    assert run.returncode == SUCCESS and "only where a rollout confirms it" in run.stdout
    listed = json.loads(saca("memory", "--memory", "bank.db", "list", "--json", cwd=tmp_path).stdout)
    assert {one["trust"] for one in listed} == {"unchecked"} and {one["origin"] for one in listed} == {"simulation"}
    again = saca("memory", "--memory", "bank.db", "import", str(cases), cwd=tmp_path)
    assert again.returncode == SUCCESS and f"0 cases taken over, {len(listed)} were there already" in again.stdout
    told = figures(saca("memory", "--memory", "bank.db", "import", str(cases), "--json", cwd=tmp_path))
    assert told == {"schema": "saca.memory_import/1", "file": "bank.db", "taken": 0, "left_out": len(listed)}
    assert len(json.loads(saca("memory", "--memory", "bank.db", "list", "--json", cwd=tmp_path).stdout)) == len(listed)
    assert "[unchecked]" in saca("memory", "--memory", "bank.db", "list", cwd=tmp_path).stdout


def test_a_bank_is_verified_and_counted(cases, tmp_path):
    assert "there is no such memory bank" in one_error(saca("memory", "--memory", "bank.db", "verify", cwd=tmp_path), BAD_INPUT)
    saca("memory", "--memory", "bank.db", "import", str(cases), cwd=tmp_path)
    told = json.loads(saca("memory", "verify", "--memory", "bank.db", "--json", cwd=tmp_path).stdout)
    count = len(documents(cases)) - 1
    assert told["cases"] == count and told["trust"] == {"unchecked": count} and sum(told["best"].values()) == count
    assert told["digest"] in saca("memory", "--memory", "bank.db", "verify", cwd=tmp_path).stdout
    with sqlite3.connect(tmp_path / "bank.db") as bank:
        bank.execute("UPDATE cases SET details = '{\"told\": [1]}' WHERE id = 2")
    assert "id 2: details: told: want one entry per policy, 8, got 1" in one_error(
        saca("memory", "--memory", "bank.db", "verify", cwd=tmp_path), BAD_INPUT)


@pytest.mark.parametrize("spoil, message", [
    (lambda text: "", "line 1: want cases, got nothing"),
    (lambda text: text[:-20], "want JSON"),
    (lambda text: "".join(text.splitlines(keepends=True)[:-1]), "as line 1 says, got"),
    (lambda text: text.replace('"harm":', '"hurt":', 1), "line 2: harm: is missing"),
    (lambda text: text.replace("saca.cases/1", "saca.cases/2"), "line 1: schema: want saca.cases/1"),
    (lambda text: text.replace('"id":2,"policy"', '"id":1,"policy"'), "id: want each once, got 1 a second time"),
])
def test_what_is_no_export_is_refused_and_the_bank_left_alone(cases, tmp_path, spoil, message):
    (tmp_path / "cases.jsonl").write_text(spoil(cases.read_text()))
    said = one_error(saca("memory", "--memory", "bank.db", "import", "cases.jsonl", cwd=tmp_path), BAD_INPUT)
    assert said.startswith("saca: cases.jsonl: line ") and message in said
    assert not (tmp_path / "bank.db").exists()


def test_what_cannot_be_read_or_written_is_told(cases, tmp_path):
    assert "none.jsonl" in one_error(saca("memory", "import", "none.jsonl", cwd=tmp_path), BAD_INPUT)
    saca("memory", "--memory", "bank.db", "import", str(cases), cwd=tmp_path)
    assert "bank.db" in one_error(saca("memory", "--memory", "bank.db", "export", "bank.db/out.jsonl", cwd=tmp_path), CANNOT_WRITE)
    assert saca("memory", "build", "balanced", "--draws", "0", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert "balanced" in one_error(saca("memory", "build", "balancd", cwd=tmp_path), BAD_INPUT)


def test_calibrating_tells_how_often_recalls_hold(cases, tmp_path):
    run = saca("memory", "calibrate", str(cases), "--check", str(cases), "--svg", "out/curve.svg", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["memory.transfer.cases"] == len(documents(cases)) - 1
    for place in ("memory.transfer.within", "memory.transfer.check"):
        coverage = [told[f"{place}.{range}.coverage"] for range in ("above_0.9", "0.7_to_0.9", "below_0.7")]
        assert told[f"{place}.queries"] > 0 and sum(coverage) == pytest.approx(1.0)
    assert "0.9" in saca("memory", "calibrate", str(cases), cwd=tmp_path).stdout
    assert "<svg" in (tmp_path / "out/curve.svg").read_text()


def test_calibrating_wants_cases(tmp_path):
    (tmp_path / "empty.jsonl").write_text('{"schema": "saca.cases/1", "cases": 0}\n')
    assert "want cases, got none" in one_error(saca("memory", "calibrate", "empty.jsonl", cwd=tmp_path), BAD_INPUT)
    assert "none.jsonl" in one_error(saca("memory", "calibrate", "none.jsonl", cwd=tmp_path), BAD_INPUT)


SHIPPED = pathlib.Path(__file__).parents[2] / "data/memory/seed.jsonl.gz"


def test_a_new_memory_begins_with_the_shipped_cases(tmp_path):
    run = ("run", "100car_9018", "--llm", "off", "--pace", "lockstep", "--danger", "off", "--memory", "m.sqlite")
    assert saca(*run, cwd=tmp_path).returncode == SUCCESS
    record = json.loads((tmp_path / "runs/100car_9018/record.json").read_text())
    assert record["decision"]["source"] == "memory", "it finds a case at its first encounter"
    listed = json.loads(saca("memory", "list", "--memory", "m.sqlite", "--json", cwd=tmp_path).stdout)
    with gzip.open(SHIPPED, "rt") as lines:
        shipped = json.loads(next(lines))["cases"]
    assert shipped > 5_000 and [one["id"] for one in listed] == [*range(1, shipped + 2)]
    assert {(one["origin"], one["trust"]) for one in listed[:-1]} == {("simulation", "trusted"), ("recording", "trusted")}
    assert listed[-1]["source"] == "100car_9018"
    assert SHIPPED.stat().st_size < 5_000_000
    assert saca("memory", "thin", "--most", "1000", "--memory", "m.sqlite", cwd=tmp_path).returncode == SUCCESS
    assert saca(*run, cwd=tmp_path).returncode == SUCCESS
    listed = json.loads(saca("memory", "list", "--memory", "m.sqlite", "--json", cwd=tmp_path).stdout)
    assert len(listed) <= 1001, "what was forgotten does not come back"


def test_another_car_does_not_trust_the_shipped_cases(tmp_path):
    scenario = (SHIPPED.parents[2] / "scenarios/one_way.toml").read_text()
    (tmp_path / "one_way.toml").write_text(scenario.replace('car = "compact_rwd_ev"', 'car = "midsize_suv"'))
    usual = ("--llm", "off", "--pace", "lockstep", "--danger", "off", "--atlas", "off", "--no-learning", "--json", "--memory", "m.sqlite")
    saca("memory", "import", SHIPPED.parents[2] / "data/memory/seed.jsonl.gz", "--keep-trust", "--memory", "m.sqlite", cwd=tmp_path)
    as_it_is, checked = {}, {}
    for scenario in ("one_way.toml", "one_way"):
        run = saca("run", scenario, *usual, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
        previews = json.loads(run.stdout)["previews"]
        as_it_is[scenario] = sum(one["memory"]["gate"] == "cache" for one in previews)
        checked[scenario] = sum(one["memory"]["gate"] == "check" for one in previews)
    assert as_it_is["one_way"] > 0 and as_it_is["one_way.toml"] == 0 < checked["one_way.toml"]


def test_a_first_run_that_was_killed_is_begun_anew(tmp_path):
    usual = ("--llm", "off", "--pace", "lockstep", "--danger", "off", "--atlas", "off", "--memory", "m.sqlite")
    assert saca("run", "one_way", *usual, "--no-learning", cwd=tmp_path).returncode != SUCCESS, "there is nothing to read"
    with sqlite3.connect(tmp_path / "m.sqlite"):
        pass  # as the file is before its table is made
    for _ in range(2):
        assert saca("run", "one_way", *usual, cwd=tmp_path).returncode == SUCCESS
    told = json.loads(saca("memory", "verify", "--memory", "m.sqlite", "--json", cwd=tmp_path).stdout)
    assert 7_000 < told["cases"] < 8_000


def test_who_wants_a_smaller_bank_loses_what_others_stand_for(cases, tmp_path):
    for _ in range(2):
        saca("memory", "--memory", "bank.db", "import", str(cases), "--keep-trust", cwd=tmp_path)
    count = len(documents(cases)) - 1
    thinned = saca("memory", "thin", "--most", str(count - 1), "--memory", "bank.db", cwd=tmp_path)
    assert thinned.returncode == SUCCESS and f"1 cases forgotten, {count - 1} left" in thinned.stdout, thinned.stdout + thinned.stderr
    thinned = saca("memory", "thin", "--most", "0", "--memory", "bank.db", cwd=tmp_path)
    assert "nothing else is stood for by another" in thinned.stdout
    told = figures(saca("memory", "thin", "--most", "0", "--memory", "bank.db", "--json", cwd=tmp_path))
    assert (told["schema"], told["file"]) == ("saca.memory_thinning/1", "bank.db") and told["forgotten"] >= 0 and 0 < told["left"] < count
    assert "there is no such memory bank" in one_error(saca("memory", "thin", "--most", "1", "--memory", "none.db", cwd=tmp_path), BAD_INPUT)


def test_compressed_cases_are_read_and_damage_is_told(cases, tmp_path):
    packed = gzip.compress(cases.read_bytes())
    (tmp_path / "cases.jsonl.gz").write_bytes(packed)
    assert saca("memory", "import", "cases.jsonl.gz", "--memory", "bank.db", cwd=tmp_path).returncode == SUCCESS
    (tmp_path / "cut.jsonl.gz").write_bytes(packed[:-20])
    assert "cut.jsonl.gz: is damaged" in one_error(saca("memory", "import", "cut.jsonl.gz", "--memory", "bank.db", cwd=tmp_path), BAD_INPUT)


def test_what_is_not_trusted_is_rolled_out(cases, tmp_path):
    lines = cases.read_text().splitlines()
    first = json.loads(lines[1])
    poisoned = json.loads(lines[1]) | {"best_policy": 7, "policy": 7, "target_speed_mps": None, "strength": None}
    del poisoned["details"]["told"], poisoned["details"]["happened"]
    worst = max(harm for harm in first["details"]["told"] if harm is not None)
    assert first["details"]["told"][7] == worst > first["details"]["told"][0] + 0.01, "doing nothing is the worst there"
    (tmp_path / "cases.jsonl").write_text("\n".join([lines[0], json.dumps(poisoned), *lines[2:]]) + "\n")
    saca("memory", "import", "cases.jsonl", "--memory", "bank.db", cwd=tmp_path)
    run = saca("memory", "check", "--memory", "bank.db", "--draws", "4", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    count = len(lines) - 1
    assert told["schema"] == "saca.memory_check/1" and told["confirmed"] + told["open"] + told["refuted"] == count
    assert told["refuted"] >= 1 and told["confirmed"] > count / 2
    listed = json.loads(saca("memory", "list", "--memory", "bank.db", "--json", cwd=tmp_path).stdout)
    assert listed[0]["trust"] == "quarantined"
    assert sum(one["trust"] == "trusted" for one in listed) == told["confirmed"]
    again = saca("memory", "check", "--memory", "bank.db", "--draws", "4", cwd=tmp_path)
    assert f"0 cases confirmed and trusted, {told['open']} stay as they were, 0 refuted" in again.stdout
    # Where it is wanted, what is in quarantine is looked at again: a sound case that one encounter has refuted comes back, and so
    # does the poisoned one, of which by now what was rolled out is kept in place of what it said.
    with sqlite3.connect(tmp_path / "bank.db") as bank:
        sound = next(one["id"] for one in listed if one["trust"] == "trusted")
        bank.execute("UPDATE cases SET details = json_set(details, '$.trust', 'quarantined') WHERE id = ?", [sound])
    assert "0 cases confirmed" in saca("memory", "check", "--memory", "bank.db", "--draws", "4", cwd=tmp_path).stdout
    run = saca("memory", "check", "--memory", "bank.db", "--draws", "4", "--quarantined", "--json", cwd=tmp_path)
    back = json.loads(run.stdout)
    assert (back["confirmed"], back["open"], back["refuted"]) == (1 + told["refuted"], told["open"], 0)
    listed = json.loads(saca("memory", "list", "--memory", "bank.db", "--json", cwd=tmp_path).stdout)
    assert {one["id"]: one["trust"] for one in listed}[sound] == "trusted" == listed[0]["trust"]
    recalled = json.loads(saca("memory", "show", str(listed[0]["id"]), "--memory", "bank.db", cwd=tmp_path).stdout)
    assert recalled["details"]["told"][7] == max(harm for harm in recalled["details"]["told"] if harm is not None), "the truth"
    assert "no such memory bank" in one_error(saca("memory", "check", "--memory", "none.db", cwd=tmp_path), BAD_INPUT)
    assert "tank" in one_error(saca("memory", "check", "--memory", "bank.db", "--car", "tank", cwd=tmp_path), BAD_INPUT)


def test_what_another_car_trusts_stays_as_it_is(cases, tmp_path):
    saca("memory", "import", cases, "--keep-trust", "--memory", "bank.db", cwd=tmp_path)
    check = ("memory", "check", "--memory", "bank.db", "--draws", "4", "--car", "midsize_suv", "--json")
    told = json.loads(saca(*check, cwd=tmp_path).stdout)
    count = len(documents(cases)) - 1
    assert told["added"] > 0 and told["confirmed"] == told["refuted"] == 0
    assert told["added"] + told["open"] + told["refuted_for_this_car"] <= count
    saca("memory", "export", "out.jsonl", "--memory", "bank.db", cwd=tmp_path)
    _, *kept = documents(tmp_path / "out.jsonl")
    assert kept[:count] == documents(cases)[1:] and len(kept) == count + told["added"]
    assert all("happened" not in one["details"] and one["details"]["told"] for one in kept[count:])
    assert json.loads(saca(*check, cwd=tmp_path).stdout)["added"] == 0


def test_stats_tell_what_a_bank_has_seen(cases, tmp_path):
    assert saca("memory", "import", cases, "--keep-trust", "--memory", "bank.db", cwd=tmp_path).returncode == SUCCESS
    told = json.loads(saca("memory", "stats", "--memory", "bank.db", "--json", cwd=tmp_path).stdout)
    assert told["schema"] == "saca.memory_stats/1"
    scenes = [one["scene"] for one in documents(cases)[1:]]
    assert told["cases"] == sum(cell["cases"] for cell in told["cells"]) == len(scenes)
    slow = sum(scene["ego"]["forward_mps"] < 8.0 for scene in scenes)  # hardly anything sideways
    assert sum(cell["cases"] for cell in told["cells"] if cell["to_mps"] == 8.0) == slow
    with_pedestrians_only = sum({actor["kind"] for actor in scene["actors"]} == {"pedestrian"} for scene in scenes)
    assert sum(cell["cases"] for cell in told["cells"] if cell["situation"] == "pedestrian") >= with_pedestrians_only
    assert 0.0 < told["recall_us"]["p50"] <= told["recall_us"]["p99"]
    lines = saca("memory", "stats", "--memory", "bank.db", cwd=tmp_path).stdout
    assert f"{len(scenes)} cases" in lines and "crossing" in lines
    assert "no such memory bank" in one_error(saca("memory", "stats", "--memory", "none.db", cwd=tmp_path), BAD_INPUT)


def test_a_case_is_shown_as_a_page(cases, tmp_path):
    assert saca("memory", "import", cases, "--keep-trust", "--memory", "bank.db", cwd=tmp_path).returncode == SUCCESS
    assert saca("memory", "show", "1", "--memory", "bank.db", "--html", "case.html", cwd=tmp_path).returncode == SUCCESS
    page = (tmp_path / "case.html").read_text()
    first = documents(cases)[1]
    assert first["source"] in page and "Harm of each policy" in page
    assert page.count("% alike") == 5 and "<script src" not in page
    happened = [harm for harm in first["details"]["happened"] if harm is not None]
    assert f"{max(happened):.3f}" in page
    assert "nowhere" in one_error(saca("memory", "show", "1", "--memory", "bank.db", "--html", "/proc/nowhere/case.html", cwd=tmp_path), CANNOT_WRITE)


def test_scales_are_fitted_and_held_against_other_cases(cases, tmp_path):
    run = saca("memory", "calibrate", cases, "--fit", "--check", cases, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["memory.scales.is_done"] is True
    assert 0.0 <= told["memory.scales.error.fitted"] <= told["memory.scales.error.shipped"]
    assert told["memory.scales.speed.fitted"] > 0.0
    assert told["memory.scales.check_error.shipped"] == pytest.approx(told["memory.scales.error.shipped"]), "all are asked"
    untold = documents(cases)
    for one in untold[1:]:
        one["details"].pop("told")
    (tmp_path / "untold.jsonl").write_text("\n".join(map(json.dumps, untold)) + "\n")
    assert "untold.jsonl: want cases that tell" in one_error(saca("memory", "calibrate", "untold.jsonl", "--fit", cwd=tmp_path), BAD_INPUT)
