"""`saca harm`."""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import CANNOT_WRITE, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca


def above_rest(intercept, exponent):
    """The part of a logistic risk that is due to its exponent; data/harm.toml."""
    p, base = (1 / (1 + math.exp(-z)) for z in (intercept + exponent, intercept))
    return (p - base) / (1 - base)


def test_the_curves_are_those_of_the_sources(tmp_path):
    run = saca("harm", "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    for k, speed in enumerate(told["speed_mps"]):
        # Rosen and Sander 2009; LR4S.
        assert told["probability"]["pedestrian_killed"][k] == pytest.approx(above_rest(-6.9, 0.090 * 3.6 * speed), rel=1e-9)
        assert told["probability"]["occupant_front_severe"][k] == pytest.approx(above_rest(-4.457, 0.177 * speed), rel=1e-9)
    for curve in (*told["probability"].values(), *told["harm"].values()):
        assert curve == sorted(curve) and len(curve) == len(told["speed_mps"])


def test_the_table_and_the_picture_name_every_curve(tmp_path):
    run = saca("harm", "--svg", "out/harm.svg", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    root = ElementTree.parse(tmp_path / "out/harm.svg").getroot()
    texts = {"".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text")}
    for name in ("occupant, struck in the side: MAIS 3+", "cyclist: killed", "motorcyclist: MAIS 3+"):
        assert name in run.stdout and name in texts
    assert (tmp_path / "out/harm.svg").read_bytes() == (ROOT / "docs/harm.svg").read_bytes()


def test_what_cannot_be_written_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("harm", "--svg", "file/harm.svg", cwd=tmp_path), CANNOT_WRITE)
    assert saca("harm", "--colour", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
