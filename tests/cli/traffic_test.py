"""`saca traffic pack` and `saca traffic info`."""
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

SMALL = ROOT / "saca/lab/recordings/testdata/commonroad_small.xml"
STATE = ("<{name}><position><point><x>{x}</x><y>{y}</y></point></position><orientation><exact>0</exact></orientation>"
         "<time><exact>{step}</exact></time><velocity><exact>{speed}</exact></velocity></{name}>")


def road(cars):
    """Two lanes along x; each car: id, and its (x, y, speed) at each step."""
    lanes = ""
    for lane, y, beside in ((1, 0.0, '<adjacentLeft ref="2" drivingDir="same"/>'),
                            (2, 3.5, '<adjacentRight ref="1" drivingDir="same"/>')):
        bound = "<{0}Bound><point><x>0</x><y>{1}</y></point><point><x>400</x><y>{1}</y></point></{0}Bound>"
        lanes += f'<lanelet id="{lane}">' + bound.format("left", y + 1.75) + bound.format("right", y - 1.75) + beside + "</lanelet>"
    bodies = ""
    for number, states in cars:
        first, *rest = [STATE.format(name="initialState" if k == 0 else "state", step=k, x=x, y=y, speed=v)
                        for k, (x, y, v) in enumerate(states)]
        bodies += (f'<dynamicObstacle id="{number}"><type>car</type><shape><rectangle><length>4.0</length><width>1.8</width>'
                   f'</rectangle></shape>{first}<trajectory>{"".join(rest)}</trajectory></dynamicObstacle>')
    return ('<commonRoad commonRoadVersion="2020a" benchmarkID="USA_US101-1_1_T-1" source="recorded" timeStepSize="0.1" '
            'author="" affiliation=""><location><gpsLatitude>999</gpsLatitude><gpsLongitude>999</gpsLongitude></location>'
            f"{lanes}{bodies}</commonRoad>")


def two_cars():
    steady = [(60 + k, 0.0, 10.0) for k in range(40)]
    changing = [(20 + k, min(0.1 * k, 3.5), 10.0 + 0.1 * k) for k in range(40)]
    return road([(7, steady), (8, changing)])


@pytest.fixture
def recordings(tmp_path):
    folder = tmp_path / "recordings"
    (folder / "deeper").mkdir(parents=True)
    (folder / "one.xml").write_text(two_cars())
    (folder / "deeper/again.xml").write_text(two_cars())
    return folder


def test_recordings_become_a_set_that_tells_what_it_holds(recordings, tmp_path):
    packed = saca("traffic", "pack", "commonroad", recordings, "-o", "set.h5", cwd=tmp_path)
    assert packed.returncode == SUCCESS, packed.stderr
    assert "2 of at most 2" in packed.stderr  # progress
    info = saca("traffic", "info", "set.h5", cwd=tmp_path)
    assert info.returncode == SUCCESS and info.stdout == packed.stdout
    told = json.loads(saca("traffic", "info", "set.h5", "--json", cwd=tmp_path).stdout)
    assert told["schema"] == "saca.traffic_info/1"
    everything = told["all"]
    assert (everything["recordings"], everything["groups"], everything["vehicles"], everything["samples"]) == (1, 1, 2, 80)
    assert everything["vehicle_hours"] == pytest.approx(80 * 0.1 / 3600)
    # One crosses the bound at y = 1.75 and is kept in its lane 0.3 m beyond it: at y = 0, 0.1, .. 2.0 it has the other ahead.
    assert (everything["steps_left"], everything["steps_right"]) == (1, 0)
    assert everything["samples_with_lead"] == 21
    assert told["sites"]["us101"] == everything
    assert told["skipped"] == {"vehicle: kept from another file": 2, "file: all its vehicles are kept from others": 1}


def test_the_same_recordings_make_the_same_bytes(recordings, tmp_path):
    for name in ("a.h5", "b.h5"):
        assert saca("traffic", "pack", "commonroad", recordings, "-o", name, cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()


def test_files_that_cannot_be_read_are_told_and_counted(recordings, tmp_path):
    (recordings / "cut.xml").write_text(two_cars()[:2000])
    (recordings / "spot.xml").write_text(two_cars().replace("recorded", "NGSIM (SPOT)"))
    packed = saca("traffic", "pack", "commonroad", recordings, "-o", "set.h5", "--json", cwd=tmp_path)
    assert packed.returncode == SUCCESS, packed.stderr
    assert "cut.xml" in packed.stderr and "spot.xml" not in packed.stderr
    skipped = json.loads(packed.stdout)["skipped"]
    assert skipped["file or event: cannot be read"] == 1
    assert skipped["file: set-based predictions (SPOT), no recording"] == 1


def test_nothing_to_pack_is_an_error(tmp_path):
    (tmp_path / "empty").mkdir()
    command = ("traffic", "pack", "commonroad")
    assert "nowhere" in one_error(saca(*command, "nowhere", "-o", "x.h5", cwd=tmp_path), BAD_INPUT)
    assert "empty" in one_error(saca(*command, "empty", "-o", "x.h5", cwd=tmp_path), BAD_INPUT)
    (tmp_path / "empty/cut.xml").write_text("<commonRoad")
    run = saca(*command, "empty", "-o", "x.h5", cwd=tmp_path)
    assert run.returncode == BAD_INPUT and "cut.xml" in run.stderr
    assert not (tmp_path / "x.h5").exists()


def test_the_command_line_wants_an_output(recordings, tmp_path):
    assert saca("traffic", "pack", "commonroad", recordings, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("traffic", "pack", cwd=tmp_path).returncode == WRONG_COMMAND_LINE


def test_a_set_that_cannot_be_written_is_told(recordings, tmp_path):
    (tmp_path / "file").write_text("")
    run = saca("traffic", "pack", "commonroad", recordings, "-o", "file/set.h5", cwd=tmp_path)
    assert "file/set.h5" in one_error(run, CANNOT_WRITE)


def test_damage_of_a_set_is_found(recordings, tmp_path):
    assert saca("traffic", "pack", "commonroad", recordings, "-o", "set.h5", cwd=tmp_path).returncode == SUCCESS
    whole = (tmp_path / "set.h5").read_bytes()
    (tmp_path / "set.h5").write_bytes(whole[:-1])
    assert "cut off or damaged" in one_error(saca("traffic", "info", "set.h5", cwd=tmp_path), BAD_INPUT)
    assert "something else" in one_error(saca("traffic", "info", SMALL, cwd=tmp_path), BAD_INPUT)


def test_events_of_the_100_car_study_become_a_set(tmp_path):
    run = saca("traffic", "pack", "100car", ROOT / "saca/lab/recordings/testdata", "-o", "set.h5", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert (told["all"]["recordings"], told["all"]["samples"]) == (1, 62)  # the excerpt has 62 rows
    assert list(told["sites"]) == ["100car"]


NGSIM = ("Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_length,v_Width,v_Class,v_Vel,v_Acc,"
         "Lane_ID,Preceding,Following,Space_Headway,Time_Headway,Location\n")


def test_ngsims_own_files_become_a_set(tmp_path):
    rows = "".join(f"{car},{k},40,{1118846700000 + 100 * k},{6 + 12 * lane},{100 * gap + 5 * k},0,0,15,6,2,50,0,{lane},{lead},0,0,0,us-101\n"
                   for car, lane, gap, lead in ((1, 1, 1, 0), (2, 1, 0, 1), (3, 2, 0, 0)) for k in range(40))
    (tmp_path / "trajectories.csv").write_text(NGSIM + rows)
    run = saca("traffic", "pack", "ngsim", "trajectories.csv", "-o", "set.h5", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    everything = json.loads(run.stdout)["all"]
    assert (everything["vehicles"], everything["samples"], everything["samples_with_lead"]) == (3, 120, 40)
    (tmp_path / "trajectories.csv").write_text(NGSIM + rows.replace(",6,2,50,", ",6,2,fast,", 1))
    message = saca("traffic", "pack", "ngsim", "trajectories.csv", "-o", "set.h5", cwd=tmp_path)
    assert message.returncode == BAD_INPUT and "trajectories.csv:2: column v_vel: want a number" in message.stderr
