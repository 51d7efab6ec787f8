"""The memory bank beside Chroma: see run.sh."""
import argparse
import copy
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import shippable_cases

PROGRAM = os.environ.get("SACA_PROGRAM", str(ROOT / "build/release/saca"))
NUM_FOUND = 50
MOST_ACTORS = 4  # in a vector
ACTOR_KINDS = ["car", "van", "truck", "motorcycle", "bicycle", "pedestrian", "obstacle"]
DILU_DIMENSIONS = 1536  # of the text embeddings that DiLu stores (OpenAI text-embedding-ada-002)
# What makes a difference of about one (saca/onboard/match/similarity.cpp), times this, is the spread of what is shifted.
SHARE_OF_SCALE = 0.6
LOG_GRIP_SCALE, SPEED_SCALE, ALONG_SCALE, ACROSS_SCALE, ACTOR_SPEED_SCALE = 0.15, 0.7, 6.0, 0.7, 3.5


class Problem(Exception):
    """What is told in one line."""


def read_cases(path):
    """The cases of a file, at least one."""
    try:
        _, cases = shippable_cases.read_cases(pathlib.Path(path))
    except SystemExit as problem:
        raise Problem(problem.code) from None
    if not cases:
        raise Problem(f"{path}: want at least one case")
    for number, case in enumerate(cases, start=2):
        if "scene" not in case:
            raise Problem(f'{path}:{number}: want a case with its "scene", got none')
    return cases


def shifted(case, rng):
    """A case like this one: with another grip, other speeds, others elsewhere."""
    other = copy.deepcopy(case)
    scene = other["scene"]
    spread = lambda scale: rng.gauss(0.0, SHARE_OF_SCALE * scale)
    scene["grip"] = min(1.2, max(0.05, scene["grip"] * math.exp(spread(LOG_GRIP_SCALE))))
    scene["ego"]["forward_mps"] += spread(SPEED_SCALE)
    for actor in scene["actors"]:
        actor["x_m"] += spread(ALONG_SCALE)
        actor["y_m"] += spread(ACROSS_SCALE)
        if actor["kind"] != "obstacle":
            actor["vx_mps"] += spread(ACTOR_SPEED_SCALE)
    return other


def enough(cases, count, rng):
    """As many as are asked for: all of them, then shifted ones; ids from 1 on, and sources that differ."""
    made = [copy.copy(case) for case in cases[:count]]
    while len(made) < count:
        made.append(shifted(cases[len(made) % len(cases)], rng))
    for place, case in enumerate(made):
        case["id"] = place + 1
        case["source"] = f"{case['source']} {place}"
    return made


def vector_of(scene):
    """A scene as numbers of about the size 1: the ego and its road, then the nearest others, nearest first."""
    ego, road = scene["ego"], scene["road"]
    cos, sin = math.cos(road["heading_rad"]), math.sin(road["heading_rad"])
    along = lambda x, y: (cos * x + sin * y, -sin * x + cos * y)
    vector = [ego["forward_mps"] / SPEED_SCALE, math.log(scene["grip"]) / LOG_GRIP_SCALE, road["left_edge_m"] / 3.0,
              road["right_edge_m"] / 3.0, 4.0 * (road["topology"] == "intersection"), 1.25 * road["oncoming_left"],
              1.25 * road["oncoming_right"]]
    others = sorted(scene["actors"], key=lambda actor: math.hypot(actor["x_m"] - ego["x_m"], actor["y_m"] - ego["y_m"]))
    for actor in others[:MOST_ACTORS]:
        s, d = along(actor["x_m"] - ego["x_m"], actor["y_m"] - ego["y_m"])
        forward, left = along(actor["vx_mps"], actor["vy_mps"])
        vector += [s / 6.0, d / 4.0, (d + left) / ACROSS_SCALE, forward / ACTOR_SPEED_SCALE, left / 4.5,
                   actor["footprint"]["length_m"] / 1.2, 1.0 * ACTOR_KINDS.index(actor["kind"])]
    return vector + [0.0] * (7 * (MOST_ACTORS + 1) - len(vector))


def rng_signs(rng, count):
    bits = rng.getrandbits(count)
    return [1.0 if bits >> k & 1 else -1.0 for k in range(count)]


def percentiles(times):
    """Median and 99th percentile (nearest rank), in microseconds."""
    ordered = sorted(times)
    rank = lambda share: ordered[min(len(ordered) - 1, math.ceil(share * len(ordered)) - 1)]
    return {"p50_us": 1e6 * rank(0.5), "p99_us": 1e6 * rank(0.99)}


def ask_chroma(vectors, questions):
    """Builds a collection and asks it: what that takes."""
    import chromadb
    client = chromadb.EphemeralClient(settings=chromadb.Settings(anonymized_telemetry=False))
    collection = client.create_collection(f"cases_{len(vectors[0])}", embedding_function=None, metadata={"hnsw:space": "l2"})
    begin = time.perf_counter()
    at_once = client.get_max_batch_size()
    for first in range(0, len(vectors), at_once):
        part = vectors[first:first + at_once]
        collection.add(ids=[str(first + k) for k in range(len(part))], embeddings=part)
        print(f"chroma: {min(first + at_once, len(vectors))} of {len(vectors)} added", file=sys.stderr)
    built = time.perf_counter() - begin
    times = []
    for question in questions:
        begin = time.perf_counter()
        collection.query(query_embeddings=[question], n_results=NUM_FOUND, include=["distances"])
        times.append(time.perf_counter() - begin)
    return {"dimensions": len(vectors[0]), "build_s": built, **percentiles(times)}


def ask_saca(cases, folder):
    """Imports the cases into a bank of its own, and asks it."""
    file = folder / "cases.jsonl"
    with open(file, "w", encoding="utf-8") as out:
        out.write(json.dumps({"schema": "saca.cases/1", "cases": len(cases)}) + "\n")
        out.writelines(json.dumps(case) + "\n" for case in cases)
    bank = str(folder / "bank.sqlite")
    for command in (["import", str(file), "--keep-trust"], ["stats", "--json"]):
        run = subprocess.run([PROGRAM, "memory", *command, "--memory", bank], capture_output=True, text=True)
        if run.returncode != 0:
            raise Problem(f"saca memory {command[0]}: {run.stderr.strip()}")
    told = json.loads(run.stdout)
    return {"load_s": told["load_s"], "p50_us": told["recall_us"]["p50"], "p99_us": told["recall_us"]["p99"]}


def compared(options):
    rng = random.Random(options.seed)
    cases = enough(read_cases(options.cases), options.count, rng)
    asked = [vector_of(shifted(cases[rng.randrange(len(cases))], rng)["scene"]) for _ in range(options.questions)]
    vectors = [vector_of(case["scene"]) for case in cases]
    import numpy
    rows, questions = numpy.array(vectors, dtype=numpy.float32), numpy.array(asked, dtype=numpy.float32)
    signs = numpy.array([rng_signs(rng, rows.shape[1]) for _ in range(DILU_DIMENSIONS)], dtype=numpy.float32)
    wide = signs.T / math.sqrt(DILU_DIMENSIONS)  # keeps distances, nearly (Johnson and Lindenstrauss)
    results = [ask_chroma(rows.tolist(), questions.tolist()), ask_chroma((rows @ wide).tolist(), (questions @ wide).tolist())]
    with tempfile.TemporaryDirectory() as folder:
        own = ask_saca(cases, pathlib.Path(folder))
    return {"cases": len(cases), "questions": len(asked), "found": NUM_FOUND, "saca": own, "chroma": results}


def main(arguments):
    parser = argparse.ArgumentParser(prog="chroma", description=__doc__)
    parser.add_argument("cases")
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--questions", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args(arguments)
    if options.count < NUM_FOUND or options.questions < 1:
        raise Problem(f"want --count of at least {NUM_FOUND} and --questions of at least 1")
    told = compared(options)
    if options.json:
        print(json.dumps(told))
        return
    print(f"{told['cases']} cases, the {told['found']} most alike, {told['questions']} questions")
    print(f"{'':28} {'p50':>9} {'p99':>9} {'ready in':>10}")
    print(f"{'saca':28} {told['saca']['p50_us']:6.0f} us {told['saca']['p99_us']:6.0f} us {told['saca']['load_s']:8.1f} s")
    for one in told["chroma"]:
        print(f"{'chroma, ' + str(one['dimensions']) + ' dimensions':28} {one['p50_us']:6.0f} us {one['p99_us']:6.0f} us {one['build_s']:8.1f} s")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Problem as problem:
        print(f"chroma: error: {problem}", file=sys.stderr)
        sys.exit(3)
