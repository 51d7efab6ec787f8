"""saca forecast: how well it is foretold where road users will be."""
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
    for model in ("constant_velocity", "constant_turn", "lane_following", "law", "shipped"):
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
    (["head_on", "--split", "test"], BAD_INPUT, "test"),
    (["head_on", "--count", "2", "--output", "/nosuch/f.json"], CANNOT_WRITE, "/nosuch/f.json"),
])
def test_bad_input_is_refused_in_one_line(arguments, code, words):
    assert words in one_error(saca("forecast", "eval", *arguments, cwd=ROOT), code)


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
])
def test_a_fan_of_nobody_is_refused(tmp_path, arguments, words):
    assert words in one_error(show(tmp_path, *arguments), BAD_INPUT)
    assert not (tmp_path / "fan.svg").exists()
