"""`saca suite fmvss127` and `saca suite r152`: what the law asks of every car."""
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

FEW = ("--car", "compact_rwd_ev", "--rows", "stopped_lead,pass_between", "--methods", "aeb,rss")


@pytest.fixture(scope="module")
def few(tmp_path_factory):
    folder = tmp_path_factory.mktemp("regulation")
    run = saca("suite", "fmvss127", *FEW, "--json", "--output", "out/few.html", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return folder, run


def test_braking_at_t1_stops_up_to_70_and_hits_from_80_kilometres_an_hour(few):
    folder, run = few
    told = json.loads(run.stdout)
    assert json.loads((folder / "out/few.json").read_text()) == told
    stopped = {round(cell["speed_kmh"]): cell for cell in told["suite.fmvss127.cells"]
               if cell["method"] == "aeb" and cell["row"] == "stopped_lead"}
    assert [speed for speed, cell in stopped.items() if not cell["passed"]] == [80]
    assert stopped[80]["verdict"] == "contact" and stopped[80]["limit"] == "no_contact"
    assert stopped[80]["impact_speed_mps"] == pytest.approx(7.3, abs=0.4)
    assert "S7.3.1(a)" in stopped[80]["paragraph"]
    assert told["suite.fmvss127.aeb.stopped_lead.passed"] == 7
    assert told["suite.fmvss127.aeb.passed_share"] == pytest.approx(8 / 9)
    assert told["suite.fmvss127.aeb.compact_rwd_ev.passed_share"] == pytest.approx(8 / 9)
    assert told["suite.fmvss127.aeb.to_the_letter.passed"] == 9  # a friction of 1.02 saves this car
    assert told["suite.fmvss127.n"] == 9 and told["suite.fmvss127.aeb.faults"] == 0


def test_the_page_says_pass_and_fail_in_words_and_needs_no_other_file(few):
    html = (few[0] / "out/few.html").read_text()
    assert "would not be allowed on the road" in html and "FAILS: hits with" in html and "passes" in html
    assert "S7.3.1(a)" in html and "src=" not in html and "href=" not in html
    assert "suite fmvss127: 18 of" in few[1].stderr  # on two surfaces


def test_the_terminal_tells_which_rows_fail_and_by_how_much(tmp_path):
    run = saca("suite", "fmvss127", *FEW, cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "it fails 1 of 9 tests" in run.stdout and "worst at 80 km/h: hits with" in run.stdout
    assert (tmp_path / "runs/suite-fmvss127.html").exists()


def test_r152_allows_an_impact_where_its_table_does(tmp_path):
    run = saca("suite", "r152", "--car", "delivery_van", "--rows", "stopped_lead", "--methods", "nothing,aeb",
               "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    cells = [cell for cell in told["suite.r152.cells"] if cell["method"] == "nothing"]
    allowed = {round(cell["speed_kmh"]): round(3.6 * cell["allowed_impact_speed_mps"]) for cell in cells}
    assert allowed == {10: 0, 15: 0, 20: 0, 25: 0, 30: 0, 35: 0, 40: 0, 42: 0, 45: 15, 50: 25, 55: 30, 60: 35}
    assert told["suite.r152.nothing.passed"] == 0 and told["suite.r152.aeb.passed_share"] == 1.0
    for cell in cells:  # who does nothing hits with the speed it keeps
        assert cell["impact_speed_mps"] == pytest.approx(cell["speed_kmh"] / 3.6, abs=0.1)


@pytest.mark.parametrize("arguments, message", [
    (("fmvss127", "--count", 5), "--count: fmvss127 is a regulation"),
    (("fmvss127", "--methods", "prayer"), "no method is called prayer"),
    (("r152", "--output", "page.h5"), "want a name that ends in .html"),
    (("natural", "--rows", "standing"), "--rows: want it of a regulation"),
])
def test_what_cannot_be_meant_is_refused(tmp_path, arguments, message):
    assert message in one_error(saca("suite", *arguments, cwd=tmp_path), WRONG_COMMAND_LINE)


def test_a_row_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    message = one_error(saca("suite", "r152", "--rows", "moose", cwd=tmp_path), BAD_INPUT)
    assert "want one of stopped_lead" in message and "moose" in message
