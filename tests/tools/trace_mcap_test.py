"""A trace as MCAP: what goes into the file, and what mcap's own reader finds there."""
import json
import math
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "trace_mcap"
PYTHON = ROOT / "build/trace_mcap/bin/python"
sys.path.insert(0, str(TOOL))
import make  # noqa: E402

HEADER = {"type": "header", "schema": "saca.trace/1",
          "ego": {"length_m": 4.6, "width_m": 1.8, "centre_x_m": -0.5},
          "actors": [{"id": "van1", "kind": "van", "shape": "box", "length_m": 5.4, "width_m": 2.0},
                     {"id": "pedestrian1", "kind": "pedestrian", "shape": "ellipse", "length_m": 0.5, "width_m": 0.6}]}
VAN = {"id": "van1", "x_m": 30.0, "y_m": 3.5, "heading_deg": 180.0, "speed_mps": 10.0}
WALKER = {"id": "pedestrian1", "x_m": 20.0, "y_m": -2.0, "heading_deg": 90.0, "speed_mps": 1.5}
LINES = [
    {"type": "frame", "t_s": 0.0, "ego": {"x_m": 1.0, "y_m": 2.0, "heading_deg": 90.0, "speed_mps": 9.0},
     "actors": [VAN, WALKER]},
    {"type": "frame", "t_s": 0.02, "ego": {"x_m": 1.0, "y_m": 2.18, "heading_deg": 90.0, "speed_mps": 9.0},
     "actors": [VAN, WALKER],
     "perceived": {"grip": 0.9, "grip_sd": 0.0, "actors": [{**VAN, "x_m": 30.5, "existence": 0.5}]}},
    {"type": "frame", "t_s": 0.04, "ego": {"x_m": 1.0, "y_m": 2.36, "heading_deg": 90.0, "speed_mps": 9.0},
     "actors": [VAN]},
    {"type": "event", "t_s": 0.02, "plane": "reflex", "kind": "trigger", "text": "T1: now"},
]


@pytest.fixture
def trace(tmp_path):
    file = tmp_path / "trace.jsonl"
    file.write_text("".join(json.dumps(line) + "\n" for line in [HEADER, *LINES]))
    return file


def on(topic):
    return [(when, message) for name, _, when, message in make.messages(HEADER, LINES) if name == topic]


def test_messages_are_in_order_of_time_and_of_known_schemas():
    all_messages = make.messages(HEADER, LINES)
    times = [when for _, _, when, _ in all_messages]
    assert times == sorted(times)
    assert {schema for _, schema, _, _ in all_messages} == set(make.foxglove.SCHEMAS)
    for topic, count in (("/tf", 3), ("/scene", 3), ("/perceived", 2), ("/events", 1)):
        assert len(on(topic)) == count, topic
    assert on("/scene")[2][0] == 40_000_000
    assert on("/events")[0][1]["timestamp"] == {"sec": 0, "nsec": 20_000_000}


def test_the_egos_box_stands_about_its_body_and_its_frame_at_the_centre_of_mass():
    when, transform = on("/tf")[1]
    assert transform["translation"] == {"x": 1.0, "y": 2.18, "z": 0.0}
    z, w = transform["rotation"]["z"], transform["rotation"]["w"]
    assert math.degrees(2 * math.atan2(z, w)) == pytest.approx(90.0)
    ego = on("/scene")[1][1]["entities"][0]
    cube = ego["cubes"][0]
    assert (ego["id"], ego["frame_id"]) == ("ego", "world")
    assert cube["pose"]["position"]["x"] == pytest.approx(1.0)
    assert cube["pose"]["position"]["y"] == pytest.approx(2.18 - 0.5)  # heads north
    assert (cube["size"]["x"], cube["size"]["y"]) == (4.6, 1.8)


def test_who_is_gone_is_taken_away():
    first, second, third = (message for _, message in on("/scene"))
    assert [one["id"] for one in first["entities"]] == ["ego", "van1", "pedestrian1"]
    assert first["deletions"] == second["deletions"] == []
    assert [one["id"] for one in third["deletions"]] == ["pedestrian1"]
    (_, shown), (_, gone) = on("/perceived")
    assert shown["entities"][0]["cubes"][0]["pose"]["position"]["x"] == 30.5
    assert shown["entities"][0]["cubes"][0]["color"]["a"] == pytest.approx(0.5 * make.PERCEIVED_ALPHA)
    assert gone == {"entities": [], "deletions": [{"timestamp": {"sec": 0, "nsec": 40_000_000}, "type": 0, "id": "van1"}]}


def fields_are_in(message, schema):
    if schema["type"] == "object":
        return all(key in schema["properties"] and fields_are_in(value, schema["properties"][key])
                   for key, value in message.items())
    if schema["type"] == "array":
        return all(fields_are_in(item, schema["items"]) for item in message)
    return isinstance(message, {"number": (int, float), "string": str, "integer": int, "boolean": bool}[schema["type"]])


def test_every_message_keeps_its_schema():
    for _, schema, _, message in make.messages(HEADER, LINES):
        assert fields_are_in(message, make.foxglove.SCHEMAS[schema])


@pytest.mark.parametrize("text, words", [
    ("", ":1: want a header"), ("{", ":1: want one JSON object"), ('{"schema": "saca.record/1"}', ":1: want a header"),
    ('[]\n', ":1: want a header"), (json.dumps(HEADER) + "\nnot json", ":2: want one JSON object"),
    (json.dumps(HEADER) + '\n{"type": "frame"}', "not a whole trace"), (json.dumps(HEADER) + "\n7", "not a whole trace"),
    (json.dumps(HEADER) + '\n' + json.dumps({**LINES[0], "actors": [{**VAN, "id": "car7"}]}), "car7")])
def test_what_is_no_trace_is_refused(text, words, tmp_path):
    file = tmp_path / "bad.jsonl"
    file.write_text(text)
    problem = make.main(file, tmp_path / "out.mcap")
    assert problem.startswith("trace_mcap: error: ") and words in problem and "bad.jsonl" in problem
    assert list(tmp_path.iterdir()) == [file]


def test_a_trace_is_not_written_over(trace, monkeypatch):
    before = trace.read_text()
    monkeypatch.chdir(trace.parent)
    assert "want another file than the trace" in make.main(trace, "./trace.jsonl")
    assert trace.read_text() == before and list(trace.parent.iterdir()) == [trace]


READ = """
import json, sys
from mcap.reader import make_reader
with open(sys.argv[1], "rb") as stream:
    reader = make_reader(stream)
    print(json.dumps({"counts": {reader.get_summary().channels[id].topic: count for id, count in
                                 reader.get_summary().statistics.channel_message_counts.items()},
                      "messages": [[channel.topic, channel.message_encoding, schema.name, schema.encoding,
                                    json.loads(schema.data)["title"], message.log_time, json.loads(message.data)]
                                   for schema, channel, message in reader.iter_messages()]}))
"""


@pytest.mark.skipif(not PYTHON.exists(), reason="tools/trace_mcap/run.sh setup has not been run")
def test_mcaps_reader_finds_what_was_written(trace, tmp_path):
    output = tmp_path / "out.mcap"
    run = subprocess.run([TOOL / "run.sh", trace, output], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 0, run.stderr
    read = subprocess.run([PYTHON, "-c", READ, output], capture_output=True, text=True, timeout=1500)
    assert read.returncode == 0, read.stderr
    found = json.loads(read.stdout)
    assert found["counts"] == {"/tf": 3, "/scene": 3, "/perceived": 2, "/events": 1}
    wanted = make.messages(HEADER, LINES)
    assert [(m[0], m[2], m[5], m[6]) for m in found["messages"]] == wanted
    assert all(m[1] == "json" and m[3] == "jsonschema" and m[4] == m[2] for m in found["messages"])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.mcap", "trace.jsonl"]
