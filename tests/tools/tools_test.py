"""The scripts under tools/ that measure."""
import gzip
import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tool(name, *arguments):
    return subprocess.run([sys.executable, ROOT / "tools" / name, *map(str, arguments)], cwd=ROOT,
                          capture_output=True, text=True, timeout=1500)


def test_the_start_is_the_empty_line_after_the_headline(tmp_path):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho headline: T1: later\nsleep 0.3\necho\nsleep 3\necho T1: now\nsleep 3\n")
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


CASE_LINES = [json.dumps(line) + "\n" for line in ({"schema": "saca.cases/1", "cases": 2}, {"source": "100car_1", "harm": 0.5}, {"source": "100car_2", "harm": 0.25})]
BAD_CASES = [  # what is in the file, and what is said of it
    ("cut.jsonl", "".join(CASE_LINES[:2]).encode(), "cut.jsonl: want 2 cases, as the header says, got 1: it is cut"),
    ("cut.jsonl.gz", gzip.compress("".join(CASE_LINES).encode())[:-20], "cut.jsonl.gz: want a whole compressed file, got "),
    ("damaged.jsonl.gz", gzip.compress("".join(CASE_LINES).encode())[:10] + 40 * b"\xff", "damaged.jsonl.gz: want a whole compressed file, got "),
    ("plain.jsonl.gz", "".join(CASE_LINES).encode(), "plain.jsonl.gz: want a file of cases, got "),
    ("nothing.jsonl", b"", "nothing.jsonl: want cases as JSON Lines, got "),
    ("list.jsonl", b"[1]\n", "list.jsonl:1: want a header, schema saca.cases/1"),
    ("other.jsonl", b'{"schema": "saca.other/1"}\n', "other.jsonl:1: want a header, schema saca.cases/1"),
    ("no_count.jsonl", b'{"schema": "saca.cases/1"}\n', "no_count.jsonl:1: want a header, schema saca.cases/1"),
    ("no_source.jsonl", (CASE_LINES[0] + CASE_LINES[1] + "{}\n").encode(), 'no_source.jsonl:3: want a case with its "source", got none')]


@pytest.mark.parametrize("name, data, said", BAD_CASES, ids=[name for name, _, _ in BAD_CASES])
def test_cases_that_are_not_whole_are_not_shipped(tmp_path, name, data, said):
    (tmp_path / name).write_bytes(data)
    (tmp_path / "out.jsonl").write_text("before")
    refused = tool("shippable_cases.py", tmp_path / name, tmp_path / "out.jsonl")
    assert refused.returncode == 1 and said in refused.stderr and refused.stderr.count("\n") == 1
    assert (tmp_path / "out.jsonl").read_text() == "before"


def script(path, text):
    """A shell script that stands for a program."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/bash\nset -eu\n" + text)
    path.chmod(0o755)


def copied(folder, *names):
    """A folder with these files of the repository, as a checkout has them."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    return folder


OUTPUT = 'while [ "$1" != --output ] && [ "$1" != -o ]; do shift; done; output=$2\n'  # of a program's arguments


@pytest.mark.parametrize("quick", ["", "1"])
def test_weights_of_danger_that_were_trained_take_the_place_of_those_before(tmp_path, quick):
    clone = copied(tmp_path, "tools/danger.sh", "data/vehicles/compact_rwd_ev.toml")
    script(clone / "tools/setup.sh", "")
    script(clone / "bin/cmake", "")
    script(clone / "build/release/saca-train-danger", OUTPUT + 'echo trained > "$output"; echo curve > "$output.curve.csv"\n')
    script(clone / "build/release/saca", 'echo "$@" >> calls\n[ "$2" = margins ] || exit 0\nweights=$3\n' + OUTPUT + 'cp "$weights" "$output"\n')
    shipped = clone / "models/danger/compact_rwd_ev.safetensors"
    shipped.parent.mkdir(parents=True)
    shipped.write_text("old\n")
    made = clone / "build/danger_quick/compact_rwd_ev/output/compact_rwd_ev.safetensors" if quick else shipped
    for _ in range(2):  # what is done is not done again
        subprocess.run([clone / "tools/danger.sh"], check=True, env=os.environ | {"PATH": f"{clone}/bin:{os.environ['PATH']}", "SACA_DANGER_QUICK": quick})
    assert made.read_text() == "trained\n" and made.with_name(made.name + ".curve.csv").read_text() == "curve\n"
    calls = (clone / "calls").read_text()
    assert calls.count("danger margins") == 1 and calls.count(f"danger check {made.relative_to(clone)} ") == 2
    assert (shipped.read_text() == "old\n") == bool(quick)


def test_a_seed_bank_is_not_made_of_cases_that_lack_some(tmp_path):
    clone = copied(tmp_path, "tools/seed_bank.sh", "tools/shippable_cases.py", "tools/figures.py")
    # Writes cases; exits as the file named like its command says. `memory export CASES` writes some, too.
    script(clone / "build/release/saca", """echo "$1 $2" >> calls
code=$(cat "$1_$2" 2>/dev/null || echo 0)
case "$1 $2" in 'memory build' | 'cases build') while [ $# -gt 1 ]; do case $1 in -o | --for-memory) cp one.jsonl "$2";; esac; shift; done ;;
  'memory export') cp one.jsonl "$3" ;;
esac
exit "$code"
""")
    (clone / "one.jsonl").write_text('{"schema": "saca.cases/1", "cases": 1}\n' + CASE_LINES[1])
    work = clone / "build/seed_bank"
    run = lambda: subprocess.run([clone / "tools/seed_bank.sh", "hundred_car"], capture_output=True, text=True).returncode
    for command, lacking in (("memory_build", "natural.jsonl"), ("cases_build", "recorded.jsonl")):
        (clone / command).write_text("5")
        assert [run(), run()] == [5, 5] and not (work / lacking).exists()
        (clone / command).unlink()
    assert not (clone / "data/memory/seed.jsonl.gz").exists()
    assert [run(), run()] == [0, 0] and (clone / "data/memory/seed.jsonl.gz").exists() and not list(work.glob("*.part"))
    calls = (clone / "calls").read_text().splitlines()
    assert calls.count("memory build") == 2 + 2 and calls.count("cases build") == 2 + 1  # those that failed, and each once


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
