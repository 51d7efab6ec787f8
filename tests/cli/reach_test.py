"""`saca reach solve`, `show`, `compare` and `tables`."""
import base64
import fcntl
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import zipfile

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

CASE = """
schema = "saca.avoidance/1"
name = "tiny"
seen_from = "obstacle"
snapshots_s = [0.5, 1.0]

[car]
grip = 0.9
tightest_curvature_1pm = 0.235
drive_share = 0.482

[ego]
shape = "box"
length_m = 4.7
width_m = 1.9
centre_m = 0.0

[obstacle]
shape = "box"
length_m = 4.7
width_m = 1.9
speed_mps = 0.0

[grid.x]
first_m = -30.0
last_m = 10.0
points = 21

[grid.y]
last_m = 12.0
points = 9

[grid.course]
points = 12

[grid.speed]
last_mps = 18.0
points = 7
"""
NUM_CELLS = 21 * 9 * 12 * 7


def case(folder, name, *changes):
    text = CASE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / name).write_text(text)
    return name


def solved(folder, name, *arguments):
    run = saca("reach", "solve", name, "--threads", 1, *arguments, "--json", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return json.loads(run.stdout)


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """A folder with the case, its solution, and what was told of it."""
    folder = tmp_path_factory.mktemp("tiny")
    case(folder, "tiny.toml")
    return folder, solved(folder, "tiny.toml")


def test_a_solution_is_where_its_name_says(tiny):
    folder, told = tiny
    assert told["file"] == "reach/tiny.h5" and (folder / told["file"]).read_bytes().startswith(b"saca.value/2\n")
    assert (told["cells"], told["times_s"]) == (NUM_CELLS, [0.5, 1.0])
    run = saca("reach", "solve", "tiny.toml", "--output", "elsewhere/own.h5", cwd=folder)
    assert run.returncode == SUCCESS and (folder / "elsewhere" / "own.h5").exists()
    assert run.stdout.startswith(f"elsewhere/own.h5: {NUM_CELLS} cells, to 1 s, {100 * told['unsafe_share']:.2f} %")
    assert sorted(path.name for path in (folder / "reach").iterdir()) == ["tiny.h5"]


def test_more_time_makes_more_unsafe_and_more_grip_less(tiny, tmp_path):
    _, told = tiny
    shorter = solved(tmp_path, case(tmp_path, "shorter.toml", ("[0.5, 1.0]", "[0.2]")), "--without-error")
    slippery = solved(tmp_path, case(tmp_path, "slippery.toml", ("grip = 0.9", "grip = 0.4")), "--without-error")
    assert 0 < shorter["unsafe_share"] < told["unsafe_share"] < slippery["unsafe_share"] < 1


def test_threads_change_no_byte(tiny):
    folder, told = tiny
    run = saca("reach", "solve", "tiny.toml", "--threads", 3, "--output", "three.h5", cwd=folder)
    assert run.returncode == SUCCESS
    assert (folder / "three.h5").read_bytes() == (folder / told["file"]).read_bytes()


# 90,000 cells and many snapshots: takes some seconds, and leaves something all the time.
LONGER = [("[0.5, 1.0]", str([round(0.1 * k, 1) for k in range(1, 31)])), ("points = 21", "points = 61"),
          ("points = 9", "points = 13"), ("points = 12", "points = 16")]


def test_an_interrupted_solution_goes_on_and_ends_as_if_it_had_not_been(tmp_path):
    case(tmp_path, "long.toml", *LONGER)
    part = tmp_path / "own.h5.part"
    before, reached = None, []
    for _ in range(2):
        run = subprocess.Popen([PROGRAM, "reach", "solve", "long.toml", "--output", "own.h5", "--threads", "1"],
                               cwd=tmp_path, stderr=subprocess.PIPE, text=True)
        while run.poll() is None and (not part.exists() or part.stat().st_mtime_ns == before):
            time.sleep(0.001)
        run.send_signal(signal.SIGINT)
        _, told = run.communicate(timeout=1500)
        assert run.returncode == INTERRUPTED, told
        found = re.search(r"interrupted after ([0-9.]+) of 3 s; the same command goes on from own.h5.part", told)
        assert found, told
        reached.append(float(found[1]))
        before = part.stat().st_mtime_ns
    assert 0 < reached[0] < reached[1] < 3 and not (tmp_path / "own.h5").exists()
    assert solved(tmp_path, "long.toml", "--output", "own.h5")["times_s"][-1] == 3
    assert not part.exists()
    solved(tmp_path, "long.toml", "--output", "at_once.h5")
    assert (tmp_path / "own.h5").read_bytes() == (tmp_path / "at_once.h5").read_bytes()


@pytest.mark.parametrize("change, wanted", [
    (("points = 21", "points = 1"), "points"),
    (("points = 12", "points = 12.5"), "points"),
    (("last_m = 10.0", "last_m = -31.0"), "last_m"),
    (("first_m = -30.0", "first_m = nan"), "first_m"),
    (("last_mps = 18.0", "last_mps = inf"), "last_mps"),
    (("[0.5, 1.0]", "[-1.0]"), "snapshots_s"),
    (("[0.5, 1.0]", "[nan]"), "snapshots_s"),
    (("[0.5, 1.0]", "[]"), "snapshots_s"),
    (("[0.5, 1.0]", "[1.0, 0.5]"), "snapshots_s"),
    (("grip = 0.9", "grip = 0.0"), "grip"),
    (("[grid.y]", "[grid.z]"), "y: missing"),
    (('"obstacle"\n', '"above"\n'), "seen_from"),
    (('saca.avoidance/1', 'saca.avoidance/2'), "schema")])
def test_a_broken_case_is_refused_with_its_line(change, wanted, tmp_path):
    error = one_error(saca("reach", "solve", case(tmp_path, "bad.toml", change), cwd=tmp_path), BAD_INPUT)
    assert re.search(r"bad\.toml:\d+: ", error) and wanted in error
    assert [path.name for path in tmp_path.iterdir()] == ["bad.toml"]


def test_what_cannot_be_solved_is_said(tiny, tmp_path):
    folder, told = tiny
    name = case(tmp_path, "tiny.toml")
    error = one_error(saca("reach", "solve", "batmobile", cwd=tmp_path), BAD_INPUT)
    assert "batmobile" in error and "no case is there" in error
    # Said before it starts.
    error = one_error(saca("reach", "solve", name, "--memory-mib", 0.1, cwd=tmp_path), BAD_INPUT)
    assert f"{NUM_CELLS} cells" in error and "--memory-mib allows" in error
    assert [path.name for path in tmp_path.iterdir()] == ["tiny.toml"]
    for wrong in [["--memory-mib", -1], ["--threads", 0], ["--cfl", 2], ["--differences", "weno7"]]:
        assert saca("reach", "solve", name, *wrong, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("reach", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("reach", "solve", name, "--output", "file/a.h5", cwd=tmp_path), CANNOT_WRITE)


def test_only_its_own_part_is_gone_on_with(tiny, tmp_path):
    folder, told = tiny
    whole = (folder / told["file"]).read_bytes()
    part = tmp_path / "own.h5.part"
    name, other = case(tmp_path, "tiny.toml"), case(tmp_path, "other.toml", ("grip = 0.9", "grip = 0.8"))

    def refused(*arguments):
        before = part.read_bytes()
        error = one_error(saca("reach", "solve", *arguments, "--output", "own.h5", cwd=tmp_path), BAD_INPUT)
        assert part.read_bytes() == before and not (tmp_path / "own.h5").exists()
        return error

    part.write_bytes(whole)
    assert "another problem" in refused(other)
    begun = "begun by weno5, rk3, cfl 0.75, floats, solver 1, wanted"
    assert f"{begun} weno5, rk3, cfl 0.75, doubles, solver 1" in refused(name, "--double")
    assert f"{begun} upwind1, euler, cfl 1, floats, solver 1" in refused(
        name, "--differences", "upwind1", "--steps", "euler", "--cfl", "1")
    part.write_bytes(whole[:-100])
    assert "own.h5.part" in refused(name)


@pytest.mark.parametrize("name, damage, wanted", [
    ("empty", lambda whole: b"", "an empty file"),
    ("cut", lambda whole: whole[:-100], "cut off or damaged"),
    ("cut_early", lambda whole: whole[:700], "cut off or damaged"),
    ("flipped", lambda whole: whole[:2000] + bytes([whole[2000] ^ 1]) + whole[2001:], "cut off or damaged"),
    ("newer", lambda whole: whole.replace(b"saca.value/2", b"saca.value/3", 1), "saca.value/3"),
    ("bare", lambda whole: whole[512:], "HDF5 of another kind"),
    ("text", lambda whole: b"x" * 5000, "something else")])
@pytest.mark.parametrize("command", [["show", "--output", "a.png"], ["compare", "--network", "none.npz"]])
def test_a_file_that_is_not_whole_is_refused(tiny, tmp_path, name, damage, wanted, command):
    folder, told = tiny
    (tmp_path / f"{name}.h5").write_bytes(damage((folder / told["file"]).read_bytes()))
    error = one_error(saca("reach", command[0], f"{name}.h5", *command[1:], cwd=tmp_path), BAD_INPUT)
    assert f"{name}.h5" in error and wanted in error
    assert [path.name for path in tmp_path.iterdir()] == [f"{name}.h5"]


def show(folder, *arguments):
    return saca("reach", "show", "reach/tiny.h5", *arguments, cwd=folder)


def test_a_picture_is_a_png_of_the_plane_that_was_asked_for(tiny):
    folder, _ = tiny
    run = show(folder, "--output", "pictures/a.png", "--speed-mps", 12, "--course-deg", 20, "--time-s", 0.5)
    assert run.returncode == SUCCESS, run.stderr
    assert run.stdout == "pictures/a.png: V over x and y at course 20 deg, speed 12 m/s, horizon 0.5 s\n"
    picture = (folder / "pictures" / "a.png").read_bytes()
    assert picture[:16] == b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" and picture.endswith(b"IEND\xaeB`\x82")
    assert min(struct.unpack(">II", picture[16:24])) > 200
    assert show(folder, "--output", "b.png", "--speed-mps", 4).returncode == SUCCESS
    assert (folder / "b.png").read_bytes() != picture


def test_a_page_holds_the_values(tiny):
    folder, _ = tiny
    run = show(folder, "--output", "a.html")
    assert run.returncode == SUCCESS, run.stderr
    assert "course 0 deg, speed 9 m/s, horizon 1 s" in run.stdout
    page = (folder / "a.html").read_text()
    data = json.loads(re.search(r'<script type="application/json" id="record">(.*?)</script>', page, re.DOTALL)[1])
    assert data["schema"] == "saca.value_page/1" and data["times_s"] == [0.5, 1.0] and data["complete"]
    assert [(axis["name"], axis["points"]) for axis in data["axes"]] == [("x", 21), ("y", 9), ("course", 12), ("speed", 7)]
    values = base64.b64decode(data["values"])
    assert len(values) == 2 * NUM_CELLS
    coordinates = [axis["coordinates"] for axis in data["axes"]]

    def metre(byte):  # docs/formats.md
        r = (byte - 128) / 127
        return r * r * (data["extent"]["highest"] if r >= 0 else data["extent"]["lowest"])

    def value(*state):
        i, j, k, l = (min(range(len(points)), key=lambda n: abs(points[n] - at)) for points, at in zip(coordinates, state))
        return metre(values[NUM_CELLS + i + 21 * (j + 9 * (k + 12 * l))])

    # In it, and 1.3 m behind it at 18 m/s: neither a stop nor 2 m to the side can be had within 1.3 m.
    assert value(0.0, 0.0, 0.0, 18.0) > 0 and value(-6.0, 0.0, 0.0, 18.0) > 0
    # Standing there, farther away than 18 m/s gets in a second, or passing by.
    assert value(-6.0, 0.0, 0.0, 0.0) < 0 and value(-28.0, 0.0, 0.0, 18.0) < 0 and value(0.0, 12.0, 0.0, 18.0) < 0
    # What is lost in half the time is lost: up to a twentieth of a spacing, the scheme's own error.
    metres = [metre(byte) for byte in range(256)]
    assert all(metres[last] > -0.1 for first, last in zip(values[:NUM_CELLS], values[NUM_CELLS:]) if first >= 128)


FROM_THE_EGO = [
    ('seen_from = "obstacle"', 'seen_from = "ego"'),
    ("[grid.x]\nfirst_m = -30.0\nlast_m = 10.0\npoints = 21", "[grid.ahead]\nfirst_m = -10.0\nlast_m = 30.0\npoints = 21\nstretch_m = 12.0"),
    ("[grid.y]\nlast_m = 12.0", "[grid.left]\nstretch_m = 6.0\nlast_m = 12.0"), ("[grid.course]", "[grid.turned]")]


def test_seen_from_the_ego_it_is_the_same_value(tiny, tmp_path):
    solved(tmp_path, case(tmp_path, "tiny.toml", *FROM_THE_EGO))
    run = show(tmp_path, "--speed-mps", 9, "--output", "a.png")
    assert run.returncode == SUCCESS and run.stdout.startswith("a.png: V over x and y at course 0 deg"), run.stdout + run.stderr
    assert show(tmp_path, "--output", "a.html").returncode == SUCCESS
    name = network(tmp_path / "never.npz", -1.0)
    figures = []
    for folder in (tmp_path, tiny[0]):
        run = compare(folder, "--network", tmp_path / name, "--output", tmp_path / "maps.html", "--json")
        assert run.returncode == SUCCESS, run.stderr
        told = json.loads(run.stdout)
        figures.append(told["reach.authors_net.n_unsafe"])
    assert figures[0] == pytest.approx(figures[1], rel=0.25)  # cells of 2 m


def test_errors_against_known_answers_fall_with_the_order_of_the_differences(tmp_path):
    run = saca("reach", "check", "--grids", 3, "--picture", "orders.svg", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    figures = json.loads(run.stdout)
    wave = {name: figures[f"reach.check.a_wave_carried_along_{name}.order"] for name in ("upwind", "eno2", "eno3", "weno5")}
    assert wave == pytest.approx({"upwind": 1, "eno2": 2, "eno3": 3, "weno5": 5}, abs=0.2)
    assert all(value < 0.03 for key, value in figures.items() if key.endswith("error_m"))
    assert (tmp_path / "orders.svg").read_text().rstrip().endswith("</svg>")
    assert one_error(saca("reach", "check", "--grids", 2, "--picture", tmp_path, cwd=tmp_path), CANNOT_WRITE)


def test_the_papers_obstacle_has_the_papers_risk(tmp_path):
    run = saca("run", "one_way", "--pace", "lockstep", "--llm", "off", "--danger", "tables", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    ahead = json.loads(run.stdout)["previews"][0]["actors"][0]
    assert ahead["id"] == "obstacle1" and ahead["value_exact"]
    assert ahead["risk"] == pytest.approx(0.78, abs=0.03)  # Fig. 10


@pytest.mark.parametrize("arguments, code, wanted", [
    (["--speed-mps", 19], BAD_INPUT, "speed: want 0 m/s to 18 m/s, got 19 m/s"),
    (["--speed-mps", -1], BAD_INPUT, "speed"),
    (["--speed-mps", "nan"], BAD_INPUT, "speed"),
    (["--course-deg", 1e9], BAD_INPUT, "course: want"),
    (["--course-deg", 40, "--at", "course=10"], BAD_INPUT, "course is asked for twice"),
    (["--at", "height=1"], BAD_INPUT, "no axis 'height'"),
    (["--at", "x=1"], BAD_INPUT, "the first two are the plane"),
    (["--time-s", 0.7], BAD_INPUT, "want one of 0.5, 1"),
    (["--at", "speed"], WRONG_COMMAND_LINE, "NAME=NUMBER"),
    (["--at", "speed=1m"], WRONG_COMMAND_LINE, "NAME=NUMBER"),
    (["--output", "a.svg"], WRONG_COMMAND_LINE, ".png or .html"),
    (["--output", "tiny.toml/a.png"], CANNOT_WRITE, "tiny.toml")])
def test_what_cannot_be_shown_is_said(tiny, arguments, code, wanted):
    folder, _ = tiny
    if "--output" not in arguments:
        arguments = [*arguments, "--output", "refused.png"]
    error = one_error(show(folder, *arguments), code)
    assert wanted in error
    assert not (folder / "refused.png").exists()


def npy(shape, numbers):
    """An array as NumPy writes it: version 1.0, little-endian single precision."""
    head = str({"descr": "<f4", "fortran_order": False, "shape": shape})
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + struct.pack(f"<{len(numbers)}f", *numbers)


def network(path, bias, width=3):
    """Says `bias` metres, whatever it is asked."""
    shapes = {"MLP_0_Dense_0": (4, width), "MLP_0_Dense_1": (width, width), "OutputVDense": (width, 1)}
    with zipfile.ZipFile(path, "w") as archive:
        for name, (inputs, outputs) in shapes.items():
            archive.writestr(f"{name}_kernel.npy", npy((inputs, outputs), [0.0] * (inputs * outputs)))
            archive.writestr(f"{name}_bias.npy", npy((outputs,), [bias if name == "OutputVDense" else 0.0] * outputs))
    return path.name


def compare(folder, *arguments):
    return saca("reach", "compare", "reach/tiny.h5", *arguments, cwd=folder)


@pytest.mark.parametrize("bias, false_safe, false_alarm", [(-1.0, 1.0, 0.0), (1.0, 0.0, 1.0)])
def test_a_network_that_always_says_the_same_is_wrong_on_the_other_side(tiny, bias, false_safe, false_alarm):
    folder, _ = tiny
    name = network(folder / f"always{bias:g}.npz", bias)
    run = compare(folder, "--network", name, "--speed-mps", 9, "--output", "maps.html", "--json")
    assert run.returncode == SUCCESS, run.stderr
    figures = {key.removeprefix("reach.authors_net."): value for key, value in json.loads(run.stdout).items()}
    assert (figures["false_safe"], figures["false_alarm"]) == (false_safe, false_alarm)
    share = figures["n_unsafe"] / figures["n"]
    assert 0 < share < 1
    assert figures["sign_agreement"] == pytest.approx(share if bias > 0 else 1 - share)
    # Its lattice: metres from 50 m behind to abreast, 8 m to either side, 5 degrees to 40, each m/s to 18.
    assert figures["n"] + figures["n_outside"] == 51 * 17 * 17 * 19
    assert figures["n"] == 31 * 17 * 17 * 19  # the grid begins at -30 m
    assert "</html>" in (folder / "maps.html").read_text()
    assert compare(folder, "--network", name, "--output", "maps.png").returncode == SUCCESS
    png = (folder / "maps.png").read_bytes()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", png[16:24])
    assert width > 1500 and height > width, "five pairs below each other"


def test_what_cannot_be_compared_is_said(tiny, tmp_path):
    folder, _ = tiny
    assert "none.npz" in one_error(compare(folder, "--network", "none.npz"), BAD_INPUT)
    (folder / "cut.npz").write_bytes(b"PK\3\4 and no more")
    assert "cut.npz" in one_error(compare(folder, "--network", "cut.npz"), BAD_INPUT)
    good = network(folder / "good.npz", 0.0)
    assert "tiny.toml" in one_error(compare(folder, "--network", good, "--output", "tiny.toml/a.html"), CANNOT_WRITE)
    assert ".png or .html" in one_error(compare(folder, "--network", good, "--output", "a.svg"), WRONG_COMMAND_LINE)
    solved(folder, case(folder, "moving.toml", ("speed_mps = 0.0", "speed_mps = 5.0")), "--without-error")
    error = one_error(saca("reach", "compare", "reach/moving.h5", "--network", good, cwd=folder), BAD_INPUT)
    assert "moving.h5" in error and "at rest" in error


def test_a_stopped_or_foreign_solution_is_not_compared(tiny, tmp_path):
    folder, _ = tiny
    good = network(tmp_path / "good.npz", 0.0)
    run = subprocess.Popen([PROGRAM, "reach", "solve", case(tmp_path, "long.toml", *LONGER), "--output", "half.h5", "--threads", "1"],
                           cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while run.poll() is None and not (tmp_path / "half.h5.part").exists():  # until it is under way
        time.sleep(0.001)
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=1500)
    assert run.returncode == INTERRUPTED
    error = one_error(saca("reach", "compare", "half.h5.part", "--network", good, cwd=tmp_path), BAD_INPUT)
    assert "half.h5.part" in error and "stopped" in error


@pytest.mark.parametrize("arguments", [
    ["solve", "air3d", "--cfl", "nan"], ["solve", "air3d", "--memory-mib", "nan"], ["show", "a.h5", "--zoom", "nan"],
    ["compare", "a.h5", "--network", "n.npz", "--speed-mps", "nan"], ["solve", "air3d", "--cfl", "0.5x"]])
def test_what_is_no_number_is_refused(arguments, tmp_path):
    run = saca("reach", *arguments, *(["--output", "a.png"] if arguments[0] == "show" else []), cwd=tmp_path)
    assert run.returncode == WRONG_COMMAND_LINE and ": want " in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_case_is_named_as_it_was_asked_for(tmp_path):
    assert "x" * 5000 in one_error(saca("reach", "solve", "x" * 5000, cwd=tmp_path), BAD_INPUT)
    error = one_error(saca("reach", "solve", "none.toml", cwd=tmp_path), BAD_INPUT)
    assert "none.toml" in error and "none.toml.toml" not in error
    assert "is a device" in one_error(saca("reach", "solve", "/dev/zero", cwd=tmp_path), BAD_INPUT)


def test_a_folder_as_output_is_refused_before_it_is_solved(tmp_path):
    (tmp_path / "there").mkdir()
    assert "is a folder" in one_error(saca("reach", "solve", "paper_ellipse", "--output", "there", cwd=tmp_path), CANNOT_WRITE)
    assert [path.name for path in tmp_path.iterdir()] == ["there"]


@pytest.fixture
def twin(tmp_path):
    """A scenario whose car is the usual one under another name: its tables are the same. With the folder of its tables."""
    name = "twin_of_" + tmp_path.name
    car = tmp_path / f"{name}.toml"
    shutil.copy(ROOT / "data/vehicles/compact_rwd_ev.toml", car)
    shutil.copy(ROOT / "data/vehicles/compact_rwd_ev.tuning.toml", tmp_path / f"{name}.tuning.toml")
    scenario = tmp_path / "twin.toml"
    usual = (ROOT / "scenarios/one_way.toml").read_text()
    scenario.write_text(usual.replace('car = "compact_rwd_ev"', f'car = "{car}"'))
    folder = tmp_path / "cache" / "saca" / "reach" / name
    folder.mkdir(parents=True)
    return scenario, folder


def test_tables_are_waited_for_while_another_program_makes_them(twin, tmp_path):
    scenario, folder = twin
    other = os.open(folder, os.O_RDONLY)
    fcntl.flock(other, fcntl.LOCK_EX)
    run = subprocess.Popen([PROGRAM, "reach", "tables", scenario, "--json"], cwd=tmp_path, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                           env=os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache")})
    told = run.stderr.readline()
    assert str(folder) in told and "another program" in told
    needed = json.loads(saca("reach", "tables", "one_way", "--json", cwd=tmp_path).stdout)
    for table in needed:
        shutil.copy(table["file"], folder)  # made by the other program
    os.close(other)
    out, rest = run.communicate(timeout=1500)
    assert run.returncode == SUCCESS and rest == ""
    assert [(table["table"], table["was_there"]) for table in json.loads(out)] == \
        [(table["table"], True) for table in needed]


def test_tables_of_what_is_not_there_are_refused(tmp_path):
    assert "none" in one_error(saca("reach", "tables", "none", cwd=tmp_path), BAD_INPUT)
