"""saca forecast: how well it is predicted where road users will be."""
import json
import pathlib
import sys
import xml.etree.ElementTree

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, one_error, saca


def figures(*arguments):
    run = saca("forecast", "eval", "head_on", "--count", "6", "--json", *arguments, cwd=ROOT)
    assert run.returncode == SUCCESS, run.stderr
    return json.loads(run.stdout)


def test_the_same_seed_gives_the_same_figures_on_any_number_of_threads():
    assert figures("--threads", "1") == figures("--threads", "2")
    assert figures("--seed", "2") != figures("--seed", "1")


def test_each_model_has_every_figure_with_its_interval():
    told = figures()
    assert told["forecast.head_on.num_encounters"] == 6 and told["forecast.head_on.num_failed"] == 0
    assert 0 < told["forecast.head_on.num_acting"] < told["forecast.head_on.num_forecasts"]
    for model in ("constant_velocity", "constant_turn", "lane_following", "law", "particle_filter", "mixture_lstm", "shipped"):
        for time in ("500ms", "1000ms", "2000ms", "3000ms"):
            place = f"forecast.head_on.all.nll.{time}.{model}"
            assert told[place + ".lo"] <= told[place] <= told[place + ".hi"]
            assert 0.0 <= told[f"forecast.head_on.all.within_90_across.{time}.{model}"] <= 1.0
    # Of more ways on one is at least as near.
    assert told["forecast.head_on.all.mean_miss_of_12.over_time.shipped"] <= told["forecast.head_on.all.mean_miss_of_6.over_time.shipped"]


def test_the_figures_go_into_a_file_too(tmp_path):
    assert figures("--output", str(tmp_path / "f.json")) == json.loads((tmp_path / "f.json").read_text())


@pytest.mark.parametrize("arguments, code, words", [
    (["nosuch"], BAD_INPUT, "nosuch: no suite or family is called so"),
    (["100car"], BAD_INPUT, "--data: want the folder of the 100-Car study's release"),
    (["traffic"], BAD_INPUT, "--data: want folders with CommonRoad files"),
    (["traffic", "--data", "no/such/folder"], BAD_INPUT, "no/such/folder"),
    (["head_on", "--split", "test"], BAD_INPUT, "test"),
    (["head_on", "--count", "2", "--output", "/dev/null/f.json"], CANNOT_WRITE, "/dev/null/f.json"),
])
def test_bad_input_is_refused_in_one_line(arguments, code, words):
    assert words in one_error(saca("forecast", "eval", *arguments, cwd=ROOT), code)


STATE = ("<{name}><position><point><x>{x}</x><y>{y}</y></point></position><orientation><exact>0</exact></orientation>"
         "<time><exact>{step}</exact></time><velocity><exact>{speed}</exact></velocity></{name}>")


def recording(site, first_id):
    """Two cars behind each other in a lane along x for 9 s; the one ahead brakes at 3 m/s2 from 4 s on."""
    def ahead(t):
        braking = max(0.0, t - 4.0)
        return 45 + 15 * t - 1.5 * min(braking, 5.0) ** 2, 15 - 3 * min(braking, 5.0)

    cars = ""
    for number, way in ((first_id, lambda t: (20 + 12 * t, 12)), (first_id + 1, ahead)):
        first, *rest = [STATE.format(name="initialState" if k == 0 else "state", step=k, x=way(k / 10)[0], y=0, speed=way(k / 10)[1]) for k in range(91)]
        cars += (f'<dynamicObstacle id="{number}"><type>car</type><shape><rectangle><length>4.0</length><width>1.8</width></rectangle></shape>'
                 f'{first}<trajectory>{"".join(rest)}</trajectory></dynamicObstacle>')
    bound = "<{0}Bound><point><x>0</x><y>{1}</y></point><point><x>400</x><y>{1}</y></point></{0}Bound>"
    return (f'<commonRoad commonRoadVersion="2020a" benchmarkID="USA_{site}-1_1_T-1" source="recorded" timeStepSize="0.1" author="" affiliation="">'
            '<location><gpsLatitude>999</gpsLatitude><gpsLongitude>999</gpsLongitude></location><lanelet id="1">'
            + bound.format("left", 1.75) + bound.format("right", -1.75) + f"</lanelet>{cars}</commonRoad>")


def test_recorded_traffic_counts_by_groups_that_share_nobody(tmp_path):
    (tmp_path / "one.xml").write_text(recording("US101", 7))
    (tmp_path / "two.xml").write_text(recording("US101", 307))
    run = saca("forecast", "eval", "traffic", "--data", str(tmp_path), "--json", cwd=ROOT)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["forecast.traffic.num_encounters"] == 2  # blocks of a hundred vehicles
    # Tracks settle until 1.7 s; forecasts at 2, 2.5, ... 4.5 s end 1.2 s before the recording does. Each sees the other.
    assert told["forecast.traffic.num_forecasts"] == 2 * 2 * 6
    # It acts where braking costs 0.5 * 3 * (2 - d)^2 > 1 m within 2 s, d until it brakes: at 3, 3.5, 4 and 4.5 s.
    assert told["forecast.traffic.num_acting"] == 2 * 4
    assert told["forecast.traffic.us101_acting.nll.2000ms.shipped.n"] == 2
    assert run.stdout == saca("forecast", "eval", "traffic", "--data", str(tmp_path), "--json", "--threads", "2", cwd=ROOT).stdout


def test_traffic_of_a_site_that_intentions_have_seen_is_refused(tmp_path):
    (tmp_path / "one.xml").write_text(recording("Peach", 7))
    message = one_error(saca("forecast", "eval", "traffic", "--data", str(tmp_path), cwd=ROOT), BAD_INPUT)
    assert "without_peachtree.safetensors" in message


def show(tmp_path, *arguments):
    return saca("forecast", "show", "head_on", *arguments, "-o", str(tmp_path / "fan.svg"), cwd=ROOT)


def test_a_fan_is_drawn_over_what_happened(tmp_path):
    assert show(tmp_path, "--encounter", "3", "--who", "van1", "--at-s", "4.5").returncode == SUCCESS
    picture = xml.etree.ElementTree.parse(tmp_path / "fan.svg")
    classes = [element.get("class") for element in picture.iter()]
    ways, places = classes.count("fan"), classes.count("fan-place")
    assert ways > 3 and places == 3 * ways  # after 1, 2 and 3 s
    assert "van body" in classes and "ego body" in classes


@pytest.mark.parametrize("arguments, words", [
    (("--encounter", "3", "--who", "tram1", "--at-s", "4.5"), 'head_on 3: want somebody who is perceived at 4.5 s: van1'),
    (("--encounter", "3", "--who", "van1", "--at-s", "99"), "got 99 s"),
    (("--encounter", "3", "--who", "van1", "--at-s", "-1"), "which begins at 0 s, got -1 s"),
])
def test_a_fan_of_nobody_is_refused(tmp_path, arguments, words):
    assert words in one_error(show(tmp_path, *arguments), BAD_INPUT)
    assert not (tmp_path / "fan.svg").exists()
