"""What README.md and the guide say is so: the figures of its emergency are those of a run, their commands are there."""
import json
import os
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SACA_PROGRAM", ROOT / "build/release/saca")
SUITES = json.loads((ROOT / "docs/suites.json").read_text())
README = (ROOT / "README.md").read_text(encoding="utf-8")
GUIDE = (ROOT / "docs/guide.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    folder = tmp_path_factory.mktemp("readme")
    run = subprocess.run([PROGRAM, "run", "100car_8456", "--llm", "off", "--pace", "lockstep", "--json"], cwd=folder, text=True,
                         capture_output=True, check=True)
    return json.loads(run.stdout)


def suite(command, also=""):
    return next(run for run in SUITES if run["meta.command"].startswith(command) and also in run["meta.command"])


def test_the_emergency_is_told_as_it_is(record):
    """Each sentence of README's explanation against the record."""
    decided = record["decision"]
    at_trigger = [frame for frame in record["frames"] if frame["t_s"] <= decided["time_s"] + 1e-9][-1]
    aeb, nothing = record["hindsight"][0], record["hindsight"][7]
    facts = [
        "A man drives at %.1f m/s (%.0f km/h) behind a van" % (at_trigger["ego"]["speed_mps"], 3.6 * at_trigger["ego"]["speed_mps"]),
        "When %.1f s are left, SACA acts" % at_trigger["conflict_s"],
        "he would have hit the van at %.1f m/s" % nothing["contact"]["relative_speed_mps"],
        "hit him at %.1f m/s" % nothing["later"][0]["relative_speed_mps"],
        "%.1f s later the car behind runs into him at %.1f m/s" % (aeb["contact"]["time_s"] - decided["time_s"], aeb["contact"]["relative_speed_mps"]),
        "brakes to %.1f m/s while it changes to the free lane on the left" % decided["target_speed_mps"],
        "stays %.1f m off the barrier" % record["result"]["clearance_m"]]
    for fact in facts:
        assert fact in README
    assert (nothing["contact"]["with"], nothing["later"][0]["with"], aeb["contact"]["with"]) == ("van1", "car1", "car1")
    assert (aeb["contact"]["ego_face"], decided["name"], record["road"]["left_beyond"]) == ("rear", "ES-B-L", "barrier")
    assert record["result"]["contact"] is None and "left edge" in record["result"]["nearest"]["to"] and not record["switches"]


def test_the_figures_of_the_suites_are_those_of_their_page():
    cars = suite("saca suite 100car")
    met, count = cars["suite.100car.aeb.contact"], cars["suite.100car.aeb.contact.n"]
    assert f"fails there, as it does in {met * count:.0f} of the {count} recorded emergencies" in README
    figures = {}
    for name in ("balanced", "natural"):
        run = suite(f"saca suite {name}", "--split test")
        figures[name] = {key: run[f"suite.{name}.saca.{key}"] for key in ("regret", "materially_worse_than_aeb", "false_triggers")}
        figures[name]["share"] = figures[name]["regret"] / run[f"suite.{name}.aeb.regret"]
        assert run[f"suite.{name}.n"] == 600
    balanced, natural = figures["balanced"], figures["natural"]
    assert f"leaves {100 * balanced['share']:.1f} and {100 * natural['share']:.1f} % of the avoidable harm" in README
    worse = "materially_worse_than_aeb"
    assert f"worse than braking in {100 * balanced[worse]:.1f} and {100 * natural[worse]:.1f} %" in README
    assert "acts in nearly half of the twins" in README and all(0.4 < one["false_triggers"] < 0.5 for one in figures.values())


def test_their_commands_are_there():
    lines = [re.findall(r"build/release/saca ([^#&\n]+)", text) for text in (README, GUIDE)]
    assert len(lines[0]) == 5 and len(lines[1]) > 25
    lines = lines[0] + lines[1]
    for line in lines:
        words = line.split()
        options = [word for word in words if word.startswith("--")]
        depth = 2 if words[0] in ("memory", "import", "reach", "atlas", "model", "intent", "vehicle", "forecast") else 1
        told = subprocess.run([PROGRAM, *words[:depth], "--help"], text=True, capture_output=True)
        assert told.returncode == 0, line
        for option in options:
            assert option in told.stdout, line
