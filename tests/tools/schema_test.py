"""The JSON Schema of scenarios: what an editor accepts and refuses."""
import copy
import json
import pathlib
import re
import tomllib

import jsonschema
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "scenarios" / "scenario.schema.json").read_text())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
EVERYTHING = ROOT / "tests" / "fuzz" / "corpus" / "scenario" / "everything.toml"  # the reader's test loads it too
SHIPPED = sorted((ROOT / "scenarios").glob("*.toml"))

VAN, CAR, ACCELERATES, TRUCK, CHANGES, FOLLOWS, WALKS, BICYCLE, GHOST, WALL = range(10)


def problems(scenario):
    return [error.message for error in VALIDATOR.iter_errors(scenario)]


def everything():
    return tomllib.loads(EVERYTHING.read_text())


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("path", [*SHIPPED, EVERYTHING], ids=lambda path: path.stem)
def test_scenarios_that_the_reader_takes_validate(path):
    scenario = tomllib.loads(path.read_text())
    if "splits" in path.stem or "schema" not in scenario:
        pytest.skip("no scenario")
    assert problems(scenario) == []


def test_scenarios_are_shipped():
    assert len(SHIPPED) >= 5


def start(actor, **keys):
    return lambda scenario: scenario["actors"][actor]["start"].update(keys)


def actor(index, **keys):
    return lambda scenario: scenario["actors"][index].update(keys)


def without(*path):
    def change(scenario):
        table = scenario
        for key in path[:-1]:
            table = table[key]
        del table[path[-1]]
    return change


def top(table, **keys):
    return lambda scenario: (scenario[table] if table else scenario).update(keys)


WRONG = {
    "another schema": top(None, schema="saca.scenario/2"),
    "a name that is a path": top(None, name="../x"),
    "an unknown key": top(None, gripp=0.9),
    "no source": without("source"),
    "no grip": top(None, grip=0),
    "a unit that is not ours": lambda s: s["ego"]["start"].update(speed_kmh=50),
    "a word for a number": lambda s: s["ego"]["start"].update(speed_mps="fast"),
    "an ego against its lane": lambda s: s["ego"]["start"].update(heading_deg=180),
    "a start and a recording": lambda s: s["ego"].update(recording={}),
    "an edge on the wrong side": top("road", right_edge_m=3),
    "ground that is not known": top("road", left_beyond="sand"),
    "a negative error": top("perception", position_sd_m=-1),
    "a probability above 1": top("perception", dropout=1.5),
    "a latency in ms": top("perception", latency_ms=100),
    "no size": actor(VAN, length_m=0),
    "a car's mass in tonnes": actor(CAR, mass_kg=1.5),
    "a truck as light as a car": actor(TRUCK, mass_kg=900),
    "a body without a width": without("actors", VAN, "width_m"),
    "an unknown kind": actor(VAN, kind="lorry"),
    "an unknown behaviour": start(VAN, behaviour="glide"),
    "one that holds and moves": start(VAN, speed_mps=3),
    "another behaviour's key": start(CAR, brake_at_s=1),
    "no acceleration": without("actors", ACCELERATES, "start", "acceleration_mps2"),
    "a braking that speeds up": start(TRUCK, deceleration_mps2=-4),
    "a lane change without an end": without("actors", CHANGES, "start", "to_d_m"),
    "a lane change across the road": start(CHANGES, heading_deg=90),
    "a lane change at rest": start(CHANGES, speed_mps=0),
    "a reaction of 4 s": start(FOLLOWS, reaction_s=4),
    "a follower without a reaction": without("actors", FOLLOWS, "start", "reaction_s"),
    "a pedestrian that follows": actor(FOLLOWS, kind="pedestrian"),
    "a car that walks": actor(WALKS, kind="car"),
    "a runner without a speed": without("actors", WALKS, "start", "run_mps"),
    "an unknown deed": start(WALKS, then="wait"),
    "a ghost nobody believes in": without("actors", GHOST, "existence"),
    "somebody who half exists": actor(VAN, existence=0.5),
    "a ghost that follows": actor(FOLLOWS, ghost=True, existence=0.5),
    "a wall with a width": actor(WALL, width_m=1),
    "a car that is a line": actor(WALL, kind="car"),
    "an obstacle that moves": lambda s: s["actors"][WALL].update(start=copy.deepcopy(s["actors"][CAR]["start"])),
    "an unknown cue": lambda s: s["cues"][0].update(kind="tram"),
    "a cue without a place": without("cues", 0, "y_m"),
    "five cues": lambda s: s.update(cues=s["cues"][:1] * 5),
    "33 actors": lambda s: s.update(actors=s["actors"][:1] * 33),
}


@pytest.mark.parametrize("mistake", WRONG)
def test_what_is_wrong_is_refused(mistake):
    scenario = everything()
    WRONG[mistake](scenario)
    assert problems(scenario), mistake


def recorded():
    return tomllib.loads((ROOT / "scenarios" / "100car_8911.toml").read_text())


@pytest.mark.parametrize("column", ["t_s", "x_m", "heading_deg", "speed_mps", "yaw_rate_degps"])
def test_a_recording_needs_every_column(column):
    scenario = recorded()
    del scenario["ego"]["recording"][column]
    assert problems(scenario)


def kinds_of(schema):
    """The kind of a value and what it may be, as docs/formats.md writes them."""
    if "const" in schema or isinstance(schema.get("enum", [0])[0], str):
        words = schema.get("enum", [schema.get("const")])
        if isinstance(words[0], str):
            return "text", ", ".join(f"`{word}`" for word in words)
        return "number", str(words[0])
    if "enum" in schema:
        return "number", ", ".join(map(str, schema["enum"]))
    if schema["type"] == "array":
        kind, allowed = kinds_of(schema["items"])
        return f"list of {kind}s", allowed
    if schema["type"] == "string":
        return "text", "lower-case letters, digits, `_`" if "pattern" in schema else "any"
    if schema["type"] == "boolean":
        return "boolean", "`true`, `false`"
    low = f"more than {schema['exclusiveMinimum']}" if "exclusiveMinimum" in schema else f"{schema['minimum']}"
    return schema["type"], f"{low} to {schema['maximum']}"


def keys_of(table, path=""):
    """Each key with its schema, and whether it may be missing."""
    for key, schema in table["properties"].items():
        if schema.get("type") == "object":
            yield from keys_of(schema, f"{path}{key}.")
        elif key not in ("actors", "cues", "start", "behaviour"):
            yield f"{path}{key}", schema, key not in table["required"]


def test_the_formats_tell_kind_and_range_of_every_key():
    section = (ROOT / "docs/formats.md").read_text().partition("## Scenario (TOML")[2].partition("\n## ")[0]
    told = {}
    for key, behaviours, kind, allowed, meaning in re.findall(r"^\| `([\w.]+)`(?: of ([^|]+))? \| ([^|]+) \| ([^|]+) \| ([^|]*) \|$", section, re.M):
        for behaviour in re.findall(r"`(\w+)`", behaviours) or ([behaviours] if behaviours else [""]):
            told[key, behaviour] = kind, allowed, meaning.startswith("may be missing")
    wanted = {(key, ""): (*kinds_of(schema), may) for key, schema, may in
              [*keys_of(SCHEMA), *keys_of(SCHEMA["$defs"]["cue"], "cues."), *keys_of(SCHEMA["$defs"]["actor"], "actors.")]}
    for behaviour in ("hold", "constant_velocity", "accelerate", "brake", "lane_change", "follow", "walk"):
        for key, schema, may in keys_of(SCHEMA["$defs"][behaviour], "actors.start."):
            everywhere = (key, "all") in told
            wanted[key, "all" if everywhere else behaviour] = (*kinds_of(schema), may)
    assert told == wanted
    assert len(wanted) > 80
