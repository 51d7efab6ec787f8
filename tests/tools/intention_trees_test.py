"""The peer of the intention model: what it refuses, what its windows see, and that its forecasts are files of ours."""
import importlib.util
import json
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "intention_trees"
PYTHON = ROOT / "build/intention_trees/bin/python"
spec = importlib.util.spec_from_file_location("intention_trees_sealed", TOOL / "sealed.py")
sealed = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sealed)
needs_setup = pytest.mark.skipif(not PYTHON.exists(), reason="tools/intention_trees/run.sh setup has not been run")


def test_other_words_are_refused():
    run = subprocess.run([TOOL / "run.sh", "quickly"], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 2 and "want setup, train, predict, cross or teachers, got quickly" in run.stderr


def test_each_package_is_pinned_by_version_and_hash():
    lines = [line for line in (TOOL / "requirements.txt").read_text().splitlines() if not line.startswith("#")]
    assert {line.split("==")[0] for line in lines} == {"h5py", "lightgbm", "narwhals", "numpy", "scipy"}
    assert all(len(line.split(" --hash=sha256:")[1]) == 64 for line in lines)


@pytest.mark.parametrize("text, value", [(b"", 0xcbf29ce484222325), (b"a", 0xaf63dc4c8601ec8c),
                                         (b"foobar", 0x85944171f73967e8)])
def test_the_check_sum_is_the_published_one(text, value):
    assert sealed.fnv1a(text) == value  # Fowler, Noll, Vo: test vectors of 64-bit FNV-1a


def test_a_head_tells_format_size_and_sum():
    head = sealed.head("saca.forecasts/1", b"a")
    assert len(head) == 512 and head.rstrip(b"\0") == b"saca.forecasts/1\nbytes 1\nfnv1a af63dc4c8601ec8c\n"


def test_other_files_and_cut_ones_are_refused(tmp_path):
    path = tmp_path / "a.h5"
    with pytest.raises(sealed.Refused, match="No such file"):
        sealed.check(path, "saca.sequences/1")
    path.write_bytes(b"")
    with pytest.raises(sealed.Refused, match="want a file of saca.sequences/1, got nothing"):
        sealed.check(path, "saca.sequences/1")
    path.write_bytes(sealed.head("saca.sequences/1", b"body") + b"body")
    sealed.check(path, "saca.sequences/1")
    with pytest.raises(sealed.Refused, match="want a file of saca.forecasts/1, got saca.sequences/1"):
        sealed.check(path, "saca.forecasts/1")
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(sealed.Refused, match="cut off"):
        sealed.check(path, "saca.sequences/1")


WINDOWS = """
import json, sys
sys.path.insert(0, sys.argv[1])
import numpy, windows
rng = numpy.random.default_rng(1)
values = rng.normal(size=60)
values[rng.random(60) < 0.2] = numpy.nan
worst = 0.0
for window in windows.WINDOWS:
    mean, slope = windows.means_and_slopes(values, window)
    for t in range(60):
        part = slice(max(0, t + 1 - window), t + 1)
        known = ~numpy.isnan(values[part])
        times = 0.1 * numpy.arange(60)[part][known]
        if known.sum() >= 2:
            line = numpy.polyfit(times, values[part][known], 1)
            worst = max(worst, abs(slope[t] - line[0]), abs(mean[t] - values[part][known].mean()))
        else:
            assert numpy.isnan(slope[t])
names = ["speed_mps", "acceleration_mps2", "yaw_rate_radps", "offset_m", "lateral_speed_mps", "heading_rad", "lane_width_m",
         "gap_m", "gap_speed_mps", "steering_rad", "throttle", "brake"]
columns = {name: rng.normal(size=60) for name in names}
columns["lane_width_m"][:] = 3.5
told = windows.features(columns)[1]
columns = {name: numpy.concatenate([part[:40], rng.normal(size=20)]) for name, part in columns.items()}
columns["lane_width_m"][:] = 3.5
causal = bool(numpy.array_equal(told[:40], windows.features(columns)[1][:40], equal_nan=True))
place = windows.unwrapped(numpy.array([1.5, 1.7, -1.6, numpy.nan, -1.4, 1.6]), numpy.full(6, 3.5))
print(json.dumps([worst, causal, len(windows.features(columns)[0]) == told.shape[1], [p if p == p else None for p in place]]))
"""


@needs_setup
def test_windows_are_lines_of_the_past_alone():
    run = subprocess.run([PYTHON, "-B", "-c", WINDOWS, TOOL], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 0, run.stderr
    worst, causal, named, place = json.loads(run.stdout)
    assert worst < 1e-9 and causal and named
    assert place[3] is None
    assert [p for p in place if p is not None] == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.1])


SMALL = """
import sys
sys.path.insert(0, sys.argv[1])
import h5py, numpy, files, sealed
rng = numpy.random.default_rng(2)
path, count, frames = sys.argv[2], 40, 60
labels = numpy.repeat(numpy.arange(count) // 4 % 6, frames)  # each class in each split
with h5py.File(path, "w", userblock_size=512) as file:
    for name, text in (("names", [f"s{i}" for i in range(count)]),
                       ("splits", [("train", "train", "tune", "test")[i % 4] for i in range(count)]),
                       ("sites", [f"site{i // 20}" for i in range(count)]),
                       ("groups", [f"g{i // 5}" for i in range(count)])):
        file[f"sequences/{name}"] = numpy.bytes_("".join(line + chr(10) for line in text).encode())
    file["sequences/num_frames"] = numpy.full(count, float(frames))
    for name in files.COLUMNS:
        file[f"frames/{name}"] = rng.normal(size=count * frames)
    file["frames/speed_mps"][:] = 10.0 * labels + rng.normal(size=count * frames)
    file["frames/label"] = labels.astype(float)
    file["frames/scored"] = numpy.ones(count * frames)
sealed.seal(path, files.SEQUENCES)
"""
SCORE = """
import json, sys
sys.path.insert(0, sys.argv[1])
import h5py, numpy, files, sealed
sealed.check(sys.argv[3], files.FORECASTS)
test = [one for one in files.read_sequences(sys.argv[2]) if one.split == "test"]
truth = numpy.concatenate([one.labels for one in test])
with h5py.File(sys.argv[3]) as file:
    p = file["probabilities"][:]
    print(json.dumps([files.lines(file["names"]) == [one.name for one in test], list(p.shape),
                      float(abs(p.sum(axis=2) - 1).max()), float((p[0].argmax(axis=1) == truth).mean())]))
"""


@needs_setup
def test_what_is_told_by_the_speed_is_learned(tmp_path):
    sequences, models, forecasts = tmp_path / "s.h5", tmp_path / "models", tmp_path / "f.h5"

    def run(*arguments):
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=1500)
        assert done.returncode == 0, done.stderr
        return done.stdout

    run(PYTHON, "-B", "-c", SMALL, TOOL, sequences)
    figures = json.loads(run(PYTHON, "-B", TOOL / "make.py", "train", sequences, models, "--json", "--rounds", "15"))
    assert [head["frames_ahead"] for head in figures["heads"]] == [0, 5, 10]
    # Of 20 vehicles four maintain, and of their windows a third is kept.
    assert figures["heads"][0]["windows"] == 16 * 60 + 4 * 20 and figures["heads"][2]["windows"] == 16 * 50 + 4 * 17
    run(PYTHON, "-B", TOOL / "make.py", "predict", sequences, models, forecasts)
    names, shape, off, right = json.loads(run(PYTHON, "-B", "-c", SCORE, TOOL, sequences, forecasts))
    assert names and shape == [3, 10 * 60, 6] and off < 1e-9 and right > 0.95
    done = subprocess.run([PYTHON, "-B", TOOL / "make.py", "predict", sequences, models, forecasts, "--split", "none"],
                          capture_output=True, text=True, timeout=1500)
    assert done.returncode == 1 and "want sequences of the split none, got none; there are test, train, tune" in done.stderr


@needs_setup
def test_each_part_is_foretold_by_models_that_have_not_seen_it(tmp_path):
    sequences, forecasts = tmp_path / "s.h5", tmp_path / "f.h5"
    small = SMALL.replace('("train", "train", "tune", "test")', '("part-0", "part-1", "part-2", "other")')
    done = subprocess.run([PYTHON, "-B", "-c", small, TOOL, sequences], capture_output=True, text=True, timeout=1500)
    assert done.returncode == 0, done.stderr
    done = subprocess.run([PYTHON, "-B", TOOL / "make.py", "cross", sequences, forecasts, "--json", "--rounds", "4"],
                          capture_output=True, text=True, timeout=1500)
    assert done.returncode == 0, done.stderr
    figures = json.loads(done.stdout)
    assert [one["part"] for one in figures["parts"]] == ["part-0", "part-1", "part-2"]
    # Of the 20 vehicles of two parts those of the first group, 1 and 2, stop the training; 25 and 26 maintain.
    assert figures["sequences"] == 30 and figures["parts"][0]["heads"][0]["windows"] == 16 * 60 + 2 * 20
    done = subprocess.run([PYTHON, "-B", TOOL / "make.py", "cross", sequences, forecasts, "--parts", "none"],
                          capture_output=True, text=True, timeout=1500)
    assert done.returncode == 1 and "want three splits or more that begin with none, got 0" in done.stderr


TAUGHT = """
import json, pathlib, sys
sys.path.insert(0, sys.argv[1])
import files
sequences = {one.name: one for one in files.read_sequences(sys.argv[2])}
found = {}
for path in sorted(pathlib.Path(sys.argv[3]).glob("*.h5")):
    said = files.read_forecasts(path)[1]
    assert all(p.shape == (3, len(sequences[name].labels), 6) for name, p in said.items())
    found[path.stem] = [len(said), sorted({sequences[name].split for name in said}),
                        sorted({sequences[name].site for name in said})]
print(json.dumps(found))
"""


@needs_setup
def test_no_teacher_tells_of_what_is_left_out(tmp_path):
    sequences, folder = tmp_path / "s.h5", tmp_path / "teachers"
    small = SMALL.replace('("train", "train", "tune", "test")', '("part-0", "part-1", "part-2", "other")')
    done = subprocess.run([PYTHON, "-B", "-c", small, TOOL, sequences], capture_output=True, text=True, timeout=1500)
    assert done.returncode == 0, done.stderr
    command = [PYTHON, "-B", TOOL / "make.py", "teachers", sequences, folder, "--rounds", "4", "--site", "site1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=1500)
    assert done.returncode == 0, done.stderr
    made = sorted(line.split(":")[0] for line in done.stderr.splitlines())  # two parts left out serve both
    assert made == ["part-0_part-1.h5", "part-0_part-2.h5", "part-0_site1.h5", "part-1_part-2.h5", "part-1_site1.h5",
                    "part-2_site1.h5"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=1500)
    assert done.returncode == 0 and done.stderr == ""  # all is there
    done = subprocess.run([PYTHON, "-B", "-c", TAUGHT, TOOL, sequences, folder], capture_output=True, text=True,
                          timeout=1500)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {
        "without_part_0": [20, ["part-1", "part-2"], ["site0", "site1"]],
        "without_part_1": [20, ["part-0", "part-2"], ["site0", "site1"]],
        "without_part_2": [20, ["part-0", "part-1"], ["site0", "site1"]],
        "without_site1": [15, ["part-0", "part-1", "part-2"], ["site0"]]}
    others = [word if word != "4" else "5" for word in command]
    done = subprocess.run(others, capture_output=True, text=True, timeout=1500)
    assert done.returncode == 1 and "at most 5 rounds" in done.stderr and "to begin anew" in done.stderr
    done = subprocess.run(command[:-1] + ["nowhere"], capture_output=True, text=True, timeout=1500)
    assert done.returncode == 1 and "--site: want sites of the file, got nowhere; there are site0, site1" in done.stderr
