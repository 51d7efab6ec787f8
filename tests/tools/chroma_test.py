"""The comparison with Chroma: what is compared is what it says."""
import copy
import gzip
import json
import math
import pathlib
import random
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "chroma"
PYTHON = ROOT / "build/chroma/bin/python"
sys.path.insert(0, str(TOOL))
from importlib import util  # noqa: E402

SPECIFICATION = util.spec_from_file_location("chroma_make", TOOL / "make.py")
make = util.module_from_spec(SPECIFICATION)
SPECIFICATION.loader.exec_module(make)


@pytest.fixture(scope="module")
def cases():
    with gzip.open(ROOT / "data/memory/seed.jsonl.gz", "rt") as file:
        file.readline()
        return [json.loads(file.readline()) for _ in range(60)]


def test_more_cases_are_shifted_copies(cases):
    before = copy.deepcopy(cases)
    made = make.enough(cases, 150, random.Random(1))
    assert cases == before, "what is read stays as it is"
    assert [one["id"] for one in made] == list(range(1, 151))
    assert len({one["source"] for one in made}) == 150
    assert [one["scene"] for one in made[:60]] == [one["scene"] for one in cases]
    shifts = [made[60 + k]["scene"]["ego"]["forward_mps"] - cases[k % 60]["scene"]["ego"]["forward_mps"] for k in range(90)]
    deviation = math.sqrt(sum(shift * shift for shift in shifts) / len(shifts))
    assert 0.3 < deviation < 0.6, "0.6 of 0.7 m/s"
    assert made == make.enough(cases, 150, random.Random(1))


def test_a_vector_is_seen_along_the_road(cases):
    scene = copy.deepcopy(cases[0]["scene"])
    vector = make.vector_of(scene)
    assert len(vector) == 7 * (make.MOST_ACTORS + 1) and all(map(math.isfinite, vector))
    turned = copy.deepcopy(scene)
    angle = 0.7
    turn = lambda x, y: (math.cos(angle) * x - math.sin(angle) * y, math.sin(angle) * x + math.cos(angle) * y)
    for body in (turned["ego"], turned["road"], *turned["actors"]):
        body["x_m"], body["y_m"] = turn(body["x_m"], body["y_m"])
        body["heading_rad"] += angle
    for actor in turned["actors"]:
        actor["vx_mps"], actor["vy_mps"] = turn(actor["vx_mps"], actor["vy_mps"])
    assert make.vector_of(turned) == pytest.approx(vector)
    turned["actors"].reverse()
    assert make.vector_of(turned) == pytest.approx(vector)


def test_percentiles_are_nearest_ranks():
    assert make.percentiles([k * 1e-6 for k in range(1, 101)]) == pytest.approx({"p50_us": 50.0, "p99_us": 99.0})
    assert make.percentiles([3e-6]) == pytest.approx({"p50_us": 3.0, "p99_us": 3.0})


def test_bad_input_is_told_in_one_line(tmp_path):
    header = '{"schema": "saca.cases/1", "cases": 2}\n'
    for text in ("", "{}\n", "[]\n", "not json\n", '{"schema": "saca.cases/1", "cases": 0}\n', header + '{"source": "x", "scene": {}}\n', header + "{}\n{}\n"):
        (tmp_path / "bad.jsonl").write_text(text)
        with pytest.raises(make.Problem, match="bad.jsonl"):
            make.read_cases(tmp_path / "bad.jsonl")
    (tmp_path / "bad.jsonl.gz").write_bytes(gzip.compress(header.encode())[:-10])
    with pytest.raises(make.Problem, match="bad.jsonl.gz"):
        make.read_cases(tmp_path / "bad.jsonl.gz")
    run = subprocess.run([sys.executable, TOOL / "make.py", tmp_path / "none.jsonl"], capture_output=True, text=True)
    assert run.returncode == 3 and run.stderr.startswith("chroma: error: ") and run.stderr.count("\n") == 1


@pytest.mark.skipif(not PYTHON.exists(), reason="Chroma is not installed (tools/chroma/run.sh setup)")
def test_both_are_asked(cases, tmp_path):
    file = tmp_path / "cases.jsonl"
    file.write_text("\n".join(map(json.dumps, [{"schema": "saca.cases/1", "cases": len(cases)}, *cases])) + "\n")
    run = subprocess.run([PYTHON, TOOL / "make.py", file, "--count", "80", "--questions", "5", "--json"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    assert told["cases"] == 80 and [one["dimensions"] for one in told["chroma"]] == [35, make.DILU_DIMENSIONS]
    assert all(0.0 < one["p50_us"] <= one["p99_us"] for one in (told["saca"], *told["chroma"]))
