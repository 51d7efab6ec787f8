"""Mitchell's game air3D solved with hj_reachability (JAX): a reference for saca/lab/levelset, and a race against it.

usage: make.py reference   writes data/reference/air3d_hj_reachability.json
       make.py time        prints times of both on the coarse grid, and their ratio, as JSON

Values are written with the sign of this project: V >= 0 where the evader is caught. Theirs is the distance that
the evader keeps at best, less the radius of capture, so V is theirs negated, maxima are minima, and their time runs
from 0 to -2.8 s where ours goes to 2.8 s.
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "data" / "reference" / "air3d_hj_reachability.json"
PROGRAM = ROOT / "build" / "release" / "saca"
LOW, HIGH = (-6.0, -10.0, 0.0), (20.0, 10.0, 2 * math.pi)  # x [m], y [m], heading [rad], periodic
RADIUS = 5.0  # of capture [m]
HORIZON = 2.8  # [s]
GRIDS = ((51, 40, 50), (101, 79, 100))
RACED_GRID = GRIDS[0]
NUM_CELLS = 300  # of each solution that the reference keeps
RUNS = 3  # of theirs in a race; the best counts, as of ours


def spacings(shape):
    x, y, heading = ((high - low) / (points - (axis < 2))
                     for axis, (low, high, points) in enumerate(zip(LOW, HIGH, shape)))
    return x, y, heading


def covered(left, right):
    """Share of a stretch on which a value that goes linearly from `left` to `right` is >= 0."""
    if left >= 0 and right >= 0:
        return 1.0
    if left < 0 and right < 0:
        return 0.0
    return max(left, right) / abs(left - right)


def tube_volume(values):
    """Of {V >= 0}: along each line of points in x the length on which V, linear between points, is >= 0; the lines'
    lengths summed times the spacings, those at the two ends of y by half [m^2 rad]."""
    import numpy

    left, right = values[:-1], values[1:]
    both, one = (left >= 0) & (right >= 0), (left >= 0) != (right >= 0)
    span = numpy.where(one, numpy.abs(left - right), 1.0)
    lengths = (both + numpy.where(one, numpy.maximum(left, right) / span, 0.0)).sum(axis=0)  # in spacings
    lengths[[0, -1], :] /= 2
    x, y, heading = spacings(values.shape)
    return float(lengths.sum() * x * y * heading)


def chosen_cells(shape):
    """Numbers of cells, the first axis fastest, spread over all of the grid by a step that shares no factor with it."""
    total = math.prod(shape)
    step = round(total * (math.sqrt(5) - 1) / 2)
    while math.gcd(step, total) != 1:
        step += 1
    return [k * step % total for k in range(NUM_CELLS)]


def prepared(shape, double):
    """A function that solves air3D and waits for the end: values by x, y and heading in their sign, and theirs at 0 s."""
    import jax

    jax.config.update("jax_enable_x64", double)
    import hj_reachability as hj
    import jax.numpy as jnp

    real = jnp.float64 if double else jnp.float32
    grid = hj.Grid.from_lattice_parameters_and_boundary_conditions(
        hj.sets.Box(jnp.array(LOW, real), jnp.array(HIGH, real)), shape, periodic_dims=2)
    # None falls: the least distance so far counts. Open ends go on away from zero, as ours do.
    settings = hj.SolverSettings.with_accuracy(
        "very_high", hamiltonian_postprocessor=hj.solver.backwards_reachable_tube)
    system = hj.systems.Air3d()
    distance = jnp.linalg.norm(grid.states[..., :2], axis=-1) - RADIUS
    assert distance.dtype == real

    def solve():
        return hj.step(settings, system, grid, 0.0, distance, -HORIZON, progress_bar=False).block_until_ready()

    return solve, distance


def solution(shape, double):
    import numpy

    solve, distance = prepared(shape, double)
    values = -numpy.asarray(solve(), dtype=numpy.float64)
    numbered = values.ravel(order="F")
    start = -numpy.asarray(distance, dtype=numpy.float64)
    assert numpy.isfinite(values).all()
    return {"points": list(shape), "precision": "double" if double else "float",
            "tube_volume_m2_rad": tube_volume(values), "start_volume_m2_rad": tube_volume(start),
            "least_value_m": float(values.min()), "greatest_value_m": float(values.max()),
            "cells": [[cell, float(numbered[cell])] for cell in chosen_cells(shape)]}


def versions():
    import importlib.metadata

    return {name: importlib.metadata.version(name) for name in ("hj_reachability", "jax", "jaxlib", "numpy")}


def written(reference):
    """JSON with one cell a line."""
    text = json.dumps(reference, indent=1)
    for one in reference["solutions"]:
        for cell in one["cells"]:
            text = text.replace(json.dumps(cell, indent=1).replace("\n", "\n    "), json.dumps(cell), 1)
    return text + "\n"


def make_reference():
    reference = {
        "schema": "saca.air3d/1",
        "made_by": "tools/hj_reachability/run.sh reference",
        "versions": versions(),
        "game": "x' = -5 + 5 cos(heading) + a y, y' = 5 sin(heading) - a x, heading' = b - a, |a|, |b| <= 1; "
                "caught within 5 m; SI units",
        "scheme": "WENO5, global Lax-Friedrichs, TVD-RK3, CFL 0.75, rates that only raise V; tube at 2.8 s",
        "sign": "V >= 0 is caught",
        "low": LOW, "high": HIGH, "horizon_s": HORIZON,
        "volume_rule": " ".join(tube_volume.__doc__.split()),
        "cell_rule": "number of a cell, x fastest and heading slowest, and V there [m]",
        "solutions": [solution(shape, double) for shape in GRIDS for double in (False, True)]}
    REFERENCE.parent.mkdir(parents=True, exist_ok=True)
    REFERENCE.write_text(written(reference))
    for one in reference["solutions"]:
        print(one["points"], one["precision"], {key: value for key, value in one.items() if key.endswith(("rad", "_m"))})


def ours():
    """Figures of one run of our program, which takes the best of a few itself."""
    run = subprocess.run([PROGRAM, "bench", "air3d", "--json"], stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(run.stdout)


def our_time(figures, double):
    """What stands for the raced grid with as many threads as cores, WENO5 and three stages [s]."""
    points = "x".join(map(str, RACED_GRID))
    name = f"reach.air3d_{points}.seconds.t{os.cpu_count()}" + (".double" if double else "")
    if name not in figures:
        raise SystemExit(f"hj_reachability: error: saca bench air3d: want the figure {name}, got {sorted(figures)}")
    return figures[name]


def their_time(double):
    solve, _ = prepared(RACED_GRID, double)
    solve()  # compiled now
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        solve()
        times.append(time.perf_counter() - start)
    return min(times)


def race():
    """Both solve the same, one after the other, in single and in double precision, with all cores."""
    our = ours()
    figures = {"reach.jax.runs": RUNS, "reach.jax.cores": os.cpu_count()}
    for double in (False, True):
        suffix = ".double" if double else ""
        mine, theirs = our_time(our, double), their_time(double)
        figures |= {"reach.jax.seconds" + suffix: theirs, "reach.jax.ours_seconds" + suffix: mine,
                    "reach.speedup_over_jax" + suffix: theirs / mine}
    print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    actions = {"reference": make_reference, "time": race}
    if len(sys.argv) != 2 or sys.argv[1] not in actions:
        sys.exit("hj_reachability: error: want reference or time")
    actions[sys.argv[1]]()
