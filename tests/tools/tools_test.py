"""The scripts under tools/ that measure."""
import gzip
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tool(name, *arguments):
    return subprocess.run([sys.executable, ROOT / "tools" / name, *map(str, arguments)], cwd=ROOT,
                          capture_output=True, text=True, timeout=1500)


def test_the_start_is_the_empty_line_after_the_headline(tmp_path):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho headline\nsleep 0.3\necho\nsleep 3\necho T1: now\nsleep 3\n")
    program.chmod(0o755)
    run = tool("start_time.py", program, "scenario")
    assert run.returncode == 0, run.stderr
    figures = json.loads(run.stdout)
    assert 0.3 <= figures["run.start_s"] < 3.0  # not the 3 s that come after it
    assert figures["run.saca_rss_mib"] > 0


def test_a_failing_run_is_not_hidden(tmp_path):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\nexit 3\n")
    program.chmod(0o755)
    assert tool("start_time.py", program, "scenario").returncode == 3


def test_cases_are_shipped_rounded_and_without_shipped_scenarios(tmp_path):
    """What is shipped as a scenario is not in the cases, and the header says how many are left."""
    cases = tmp_path / "cases.jsonl"
    lines = [{"schema": "saca.cases/1", "cases": 2}, {"source": "100car_9018", "harm": 0.1}, {"source": "100car_1", "harm": 0.12345678, "id": 7}]
    cases.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
    out = tmp_path / "out.jsonl.gz"
    subprocess.run([ROOT / "tools" / "shippable_cases.py", cases, out], check=True)
    with gzip.open(out, "rt", encoding="utf-8") as text:
        assert [json.loads(line) for line in text] == [{"schema": "saca.cases/1", "cases": 1}, {"source": "100car_1", "harm": 0.12346, "id": 7}]
    refused = subprocess.run([ROOT / "tools" / "shippable_cases.py", tmp_path / "none", out], capture_output=True, text=True, check=False)
    assert refused.returncode == 1 and "none: want a file of cases" in refused.stderr


def test_every_case_of_a_fleet_belongs_to_one_vehicle_and_twins_to_the_same(tmp_path):
    queries = tmp_path / "queries.jsonl"
    subprocess.run([os.environ.get("SACA_PROGRAM", ROOT / "build" / "release" / "saca"), "memory", "build", "crossing", "--count", "8", "--draws", "2", "--split", "calibration", "-o", queries],
                   check=True, capture_output=True)
    told = tool("fleet.py", queries, queries, "--vehicles", "4", "--json")
    assert told.returncode == 0, told.stderr
    rows = json.loads(told.stdout)["vehicles"]
    assert [row["vehicles"] for row in rows] == [1, 2, 4]
    with queries.open(encoding="utf-8") as lines:
        everything = json.loads(next(lines))["cases"]
    for row in rows[:2]:
        assert sum(group["cases"] for group in row["groups"]) == everything  # dealt, none twice
    assert rows[2]["groups"][0]["cases"] == everything
    assert tool("fleet.py", tmp_path / "none", queries).returncode == 1
    broken = tmp_path / "broken.jsonl"
    broken.write_text("no JSON\n", encoding="utf-8")
    refused = tool("fleet.py", broken, queries)
    assert refused.returncode == 1 and "broken.jsonl: want cases as JSON Lines" in refused.stderr and "Traceback" not in refused.stderr
    sys.path.insert(0, str(ROOT / "tools"))
    import fleet
    vehicles = [fleet.vehicle_of({"source": f"crossing_1_{k}"}, 4, 1) for k in range(40)]
    assert vehicles == [fleet.vehicle_of({"source": f"crossing_1_{k}_twin"}, 4, 1) for k in range(40)] and set(vehicles) == {0, 1, 2, 3}
