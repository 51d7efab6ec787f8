"""The reference of saca/lab/levelset/air3d_reference_test.cpp: what its tool computes, and that the file belongs to it."""
import importlib.util
import json
import math
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "hj_reachability"
PYTHON = ROOT / "build/hj_reachability/bin/python"
spec = importlib.util.spec_from_file_location("hj_reachability_make", TOOL / "make.py")
make = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make)
REFERENCE = json.loads(make.REFERENCE.read_text())


def solutions():
    return [pytest.param(one, id="x".join(map(str, one["points"])) + one["precision"]) for one in REFERENCE["solutions"]]


def test_the_reference_is_of_the_pinned_versions():
    pinned = dict(line.split(" ")[0].split("==") for line in (TOOL / "requirements.txt").read_text().splitlines()
                  if not line.startswith("#"))
    assert REFERENCE["versions"] == {name: pinned[name] for name in REFERENCE["versions"]}


def test_the_reference_has_both_grids_in_both_precisions():
    assert [(tuple(one["points"]), one["precision"]) for one in REFERENCE["solutions"]] == [
        (grid, precision) for grid in make.GRIDS for precision in ("float", "double")]
    assert (REFERENCE["horizon_s"], REFERENCE["low"], REFERENCE["high"]) == (
        make.HORIZON, list(make.LOW), list(make.HIGH))


@pytest.mark.parametrize("one", solutions())
def test_a_solution_is_of_the_game(one):
    cylinder = math.pi * make.RADIUS ** 2 * 2 * math.pi
    assert one["start_volume_m2_rad"] == pytest.approx(cylinder, rel=0.005)
    assert one["tube_volume_m2_rad"] > 1.5 * cylinder
    assert [cell for cell, _ in one["cells"]] == make.chosen_cells(one["points"])
    assert all(one["least_value_m"] <= value <= one["greatest_value_m"] for _, value in one["cells"])


@pytest.mark.parametrize("one", solutions())
def test_nobody_is_safer_than_at_the_start(one):
    x, y, _ = make.spacings(one["points"])
    for cell, value in one["cells"]:
        i, j = cell % one["points"][0], cell // one["points"][0] % one["points"][1]
        start = make.RADIUS - math.hypot(make.LOW[0] + i * x, make.LOW[1] + j * y)
        assert value >= start - 1e-5


def test_precisions_agree():
    for one, other in zip(REFERENCE["solutions"][::2], REFERENCE["solutions"][1::2]):
        assert one["tube_volume_m2_rad"] == pytest.approx(other["tube_volume_m2_rad"], rel=1e-6)


def test_cells_are_chosen_once_each_and_all_over():
    cells = make.chosen_cells((51, 40, 50))
    assert len(set(cells)) == make.NUM_CELLS and 0 <= min(cells) and max(cells) < 51 * 40 * 50
    for axis, divisor, points in ((0, 1, 51), (1, 51, 40), (2, 51 * 40, 50)):
        hit = {cell // divisor % points for cell in cells}
        assert len(hit) > 0.9 * points, axis


@pytest.mark.parametrize("left, right, share", [(1, 2, 1), (-1, -2, 0), (-1, 1, .5), (3, -1, .75), (0, -1, 0), (-1, 3, .75)])
def test_a_stretch_is_cut_where_the_line_is_zero(left, right, share):
    assert make.covered(left, right) == pytest.approx(share)


@pytest.mark.parametrize("double, suffix", [(False, ""), (True, ".double")])
def test_a_race_without_its_figure_is_refused(double, suffix):
    name = f"reach.air3d_51x40x50.seconds.t{os.cpu_count()}{suffix}"
    with pytest.raises(SystemExit, match=f"want the figure {name}, got"):
        make.our_time({"reach.other": 1.0}, double)
    assert make.our_time({name: 2.5}, double) == 2.5


def test_other_words_are_refused():
    run = subprocess.run([TOOL / "run.sh", "quickly"], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 2 and "want setup, reference or time, got quickly" in run.stderr


VOLUME = """
import json, sys
import numpy
sys.path.insert(0, sys.argv[1])
import make
x, y = (numpy.linspace(make.LOW[axis], make.HIGH[axis], points) for axis, points in ((0, 27), (1, 21)))
plane = numpy.broadcast_to((x[:, None] + y[None, :] / 4 - 1)[:, :, None], (27, 21, 8))
rng = numpy.random.default_rng(1)
noise = rng.normal(size=(27, 21, 8))
slow = sum(make.covered(noise[i, j, k], noise[i + 1, j, k]) * (0.5 if j in (0, 20) else 1)
           for i in range(26) for j in range(21) for k in range(8)) * float(numpy.prod(make.spacings(noise.shape)))
print(json.dumps([make.tube_volume(plane), make.tube_volume(noise), slow]))
"""


@pytest.mark.skipif(not PYTHON.exists(), reason="tools/hj_reachability/run.sh setup has not been run")
def test_the_volume_is_exact_for_a_plane_and_as_by_hand_for_anything():
    run = subprocess.run([PYTHON, "-B", "-c", VOLUME, TOOL], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 0, run.stderr
    plane, noise, slow = json.loads(run.stdout)
    assert plane == pytest.approx(19 * 20 * 2 * math.pi)
    assert noise == pytest.approx(slow)


SMALL = """
import json, sys
sys.path.insert(0, sys.argv[1])
import make
print(json.dumps([make.solution((14, 11, 8), double) for double in (False, True)]))
"""


@pytest.mark.skipif(not PYTHON.exists(), reason="tools/hj_reachability/run.sh setup has not been run")
def test_a_small_game_is_solved_in_both_precisions():
    run = subprocess.run([PYTHON, "-B", "-c", SMALL, TOOL], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 0, run.stderr
    single, double = json.loads(run.stdout)
    assert single["tube_volume_m2_rad"] == pytest.approx(double["tube_volume_m2_rad"], rel=1e-5)
    assert double["tube_volume_m2_rad"] == pytest.approx(REFERENCE["solutions"][0]["tube_volume_m2_rad"], rel=0.2)
