"""`saca suite traffic`: SACA watches recorded traffic without taking the wheel."""
import json
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca
from traffic_test import road

STEPS = 60


def line_of_cars():
    """Three in one lane at 10 m/s, 30 m from bumper to bumper, 6 s long."""
    return road([(number, [(40 + start + k, 0.0, 10.0) for k in range(STEPS)]) for number, start in ((7, 0), (8, 34), (9, 68))])


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "a.xml").write_text(line_of_cars())
    return tmp_path


def test_following_at_constant_speed_is_told_with_its_exposure(folder):
    run = saca("suite", "traffic", "--data", "data", "--threads", 1, "--output", "out/page.html", "--json", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    figures = json.loads(run.stdout)
    assert figures == json.loads((folder / "out/page.json").read_text())
    # Each is watched from 1.7 s on until 1.2 s before its last sample, at 5.9 s: 3.0 s, 30 m.
    assert figures["traffic.drives"] == 3
    assert figures["traffic.exposure_h"] == pytest.approx(9.0 / 3600, rel=1e-6)
    assert figures["traffic.exposure_km"] == pytest.approx(0.09, rel=1e-3)
    assert figures["traffic.triggers"] == 0
    assert figures["traffic.false_triggers_per_1000km"] == 0
    assert figures["traffic.false_triggers_per_1000km.hi"] == pytest.approx(3.689 / 0.00009, rel=2e-3)
    assert figures["traffic.us101.triggers_per_hour.hi"] == pytest.approx(3.689 / (9.0 / 3600), rel=1e-3)
    page = (folder / "out/page.html").read_text()
    assert "Normal driving, in shadow" in page and not re.search(r'(src|href)="(?!#)', page)


def test_the_same_command_goes_on_and_says_the_same(folder):
    ask = ("suite", "traffic", "--data", "data", "--output", "page.html", "--json")
    first = saca(*ask, cwd=folder)
    journal = folder / "page.html.journal"
    lines = journal.read_text().splitlines(keepends=True)
    assert len(lines) == 4  # a title, and a line for each drive
    journal.write_text("".join(lines[:2]) + lines[2][:20])  # killed while it wrote
    again = saca(*ask, "--threads", 2, cwd=folder)
    assert again.stdout == first.stdout
    assert journal.read_text() == "".join(lines)
    (folder / "data/b.xml").write_text(line_of_cars().replace("US101-1", "US101-2").replace('"7"', '"17"'))
    assert "page.html.journal" in one_error(saca(*ask, cwd=folder), BAD_INPUT)  # other data


def test_only_so_many_are_drawn(folder):
    run = saca("suite", "traffic", "--data", "data", "--count", 2, "--output", "page.html", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    assert "2 of 3 recorded drives" in run.stdout


def test_bad_data_are_refused_with_file_and_reason(folder):
    def ask(*data):
        return saca("suite", "traffic", "--data", *data, "--output", "page.html", cwd=folder)
    assert "missing: want a folder" in one_error(ask("missing"), BAD_INPUT)
    (folder / "empty").mkdir()
    assert "empty: want CommonRoad files" in one_error(ask("empty"), BAD_INPUT)
    (folder / "data/b.xml").write_text("<commonRoad>")
    assert "b.xml" in one_error(ask("data"), BAD_INPUT)
    assert not (folder / "page.html").exists()


def test_a_wrong_line_is_refused(folder):
    for line in (("suite", "traffic"), ("suite", "natural", "--data", "data")):
        assert "--data" in one_error(saca(*line, cwd=folder), WRONG_COMMAND_LINE)
