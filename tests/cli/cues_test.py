"""What a place tells of that is not seen: counted, drawn, reckoned with, told."""
import json
import math
import pathlib
import re
import sys
import tomllib

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, figures, one_error, quick, saca

COUNT = 60


@pytest.fixture(scope="module")
def counted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cues")
    return folder, figures(saca("cues", "--count", COUNT, "-o", "told.toml", "--json", cwd=folder))


def test_what_was_counted_is_what_is_written(counted):
    folder, told = counted
    entries = {one["kind"]: one for one in tomllib.loads((folder / "told.toml").read_text())["cues"]}
    there = {kind: told[f"cues.{kind}.there"] for kind in entries}
    came = {kind: told[f"cues.{kind}.came"] for kind in entries}
    assert len(entries) == 7 and COUNT <= sum(there.values()) <= 2 * COUNT
    assert {kind for kind in entries if there[kind] == 0} == {"bus_at_stop", "emergency_vehicle", "low_sun"}
    for kind, entry in entries.items():
        # A kind that was not counted: as all who may come together.
        alike = [kind] if there[kind] else [other for other in entries if "speed_mps" in entries[other]]
        counts = sum(came[other] for other in alike), sum(there[other] for other in alike)
        assert entry["probability"] == pytest.approx((counts[0] + 0.5) / (counts[1] + 1), abs=0.0002)
        assert entry["source"].startswith("counted" if there[kind] else "assumption")
    assert {key.split(".")[2] for key in told if key.startswith("cues.other_cues")} == {"base_rate", "table", "logistic", "law"}
    for suite in ("cues", "other_cues"):
        assert told[f"cues.{suite}.law.log_loss.n"] == COUNT
        assert told[f"cues.{suite}.law.log_loss"] < math.log(2) < 2 * told[f"cues.{suite}.base_rate.log_loss"]


def test_the_shipped_probabilities_are_their_counts():
    text = (ROOT / "data/cues.toml").read_text()
    for entry in tomllib.loads(text)["cues"]:
        counts = re.search(r"(\d+) of (\d+)", entry["source"])
        assert entry["probability"] == pytest.approx((int(counts[1]) + 0.5) / (int(counts[2]) + 1), abs=0.0002)


def test_wrong_suite_and_place_are_refused(tmp_path):
    told = one_error(saca("family", "one_way", "--cues", "other_cue", cwd=tmp_path), BAD_INPUT)
    assert told.startswith("saca: --cues: other_cue: no suite") and "other_cues" in told
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("cues", "--count", 2, "-o", "file/cues.toml", cwd=tmp_path), CANNOT_WRITE)


def test_families_are_drawn_with_cues(tmp_path):
    run = saca("family", "one_way", "--cues", "cues", "--sample", 3, "--write", "drawn", "--svg", "sheet.svg", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    kinds = {"school_zone", "parked_vans", "work_zone", "wet_leaves"}
    for file in (tmp_path / "drawn").iterdir():
        cues = tomllib.loads(file.read_text())["cues"]
        assert cues and {one["kind"] for one in cues} <= kinds
    assert any(kind in (tmp_path / "sheet.svg").read_text() for kind in kinds)


@pytest.fixture(scope="module")
def narrow(tmp_path_factory):
    """The paper's one-way road with a bus on the right shortly before the obstacle."""
    folder = tmp_path_factory.mktemp("narrow")
    text = (ROOT / "scenarios/one_way.toml").read_text().replace('name = "one_way"', 'name = "narrow"').replace(
        "[[actors]]", '[[cues]]\nkind = "bus_at_stop"\nx_m = 60\ny_m = -4\n\n[[actors]]', 1)
    (folder / "narrow.toml").write_text(text)
    run = quick("narrow.toml", "--tape", "a.tape", cwd=folder)
    assert run.returncode == SUCCESS, run.stderr
    return folder, json.loads(next((folder / "runs").rglob("record.json")).read_text())


def test_a_record_has_the_harm_with_and_without_what_is_supposed(narrow):
    _, record = narrow
    assert record["cues"] == [{"kind": "bus_at_stop", "x_m": 60, "y_m": -4}]
    plans = [plan for plan in record["decision"]["verdict"]["plans"] if plan["harm"] is not None]
    assert all("harm_as_seen" in plan for plan in plans)
    # To the right is where somebody may come from: no plan becomes less harmful, one to that side more.
    assert all(plan["harm"] >= plan["harm_as_seen"] - 1e-3 for plan in plans)
    added = {plan["name"]: plan["harm"] - plan["harm_as_seen"] for plan in plans}
    assert added["AES-R"] > 0.001


def test_it_is_explained_and_replayed(narrow):
    folder, _ = narrow
    told = saca("explain", next((folder / "runs").rglob("record.json")), cwd=folder).stdout
    assert "likelier here than elsewhere: bus at stop." in told and "by what is seen alone)" in told
    assert saca("replay", "a.tape", cwd=folder).returncode == SUCCESS


def test_an_unknown_cue_is_refused(tmp_path):
    text = (ROOT / "scenarios/one_way.toml").read_text().replace(
        "[[actors]]", '[[cues]]\nkind = "tram"\nx_m = 68\ny_m = 0\n\n[[actors]]', 1)
    (tmp_path / "tram.toml").write_text(text)
    told = one_error(quick("tram.toml", cwd=tmp_path), BAD_INPUT)
    assert 'kind: want school_zone, bus_at_stop' in told and '"tram"' in told
