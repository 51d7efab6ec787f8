"""Turns a trace of `saca run --trace` (saca.trace/1, docs/formats.md) into an MCAP file.

    make.py TRACE.jsonl OUT.mcap

Topics: /tf (the ego in the world), /scene (bodies as they are), /perceived (as SACA took them to be,
where that differs), /events.
"""
import json
import math
import os
import pathlib
import sys

import foxglove

HEIGHTS = {"ego": 1.5, "car": 1.5, "van": 2.2, "truck": 3.5, "motorcycle": 1.5, "bicycle": 1.7,
           "pedestrian": 1.75, "obstacle": 1.0}  # [m], for the picture only: a trace has none
COLORS = {"ego": (0.1, 0.4, 0.9), "pedestrian": (0.9, 0.5, 0.1), "bicycle": (0.9, 0.5, 0.1),
          "obstacle": (0.4, 0.4, 0.4)}
OTHERS = (0.7, 0.2, 0.2)
TRUE_ALPHA, PERCEIVED_ALPHA = 1.0, 0.4  # the second times the probability that it is there


def nanoseconds(seconds):
    return round(seconds * 1e9)


def read(path):
    """The header and the other lines of a trace."""
    lines = []
    for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        try:
            line = json.loads(text)
            lines.append(line)
        except ValueError as problem:
            raise ValueError(f"{path}:{number}: want one JSON object a line: {problem}") from None
    if not lines or not isinstance(lines[0], dict) or lines[0].get("schema") != "saca.trace/1":
        raise ValueError(f"{path}:1: want a header with schema saca.trace/1")
    return lines[0], lines[1:]


def cube(kind, body, state, alpha):
    heading = math.radians(state["heading_deg"])
    ahead = body.get("centre_x_m", 0.0)
    r, g, b = COLORS.get(kind, OTHERS)
    height = HEIGHTS[kind]
    return {"pose": {"position": foxglove.vector(state["x_m"] + ahead * math.cos(heading),
                                                 state["y_m"] + ahead * math.sin(heading), height / 2),
                     "orientation": foxglove.turn(state["heading_deg"])},
            "size": foxglove.vector(body["length_m"], max(body["width_m"], 0.05), height),
            "color": {"r": r, "g": g, "b": b, "a": alpha}}


def entity(when, name, a_cube, state):
    numbers = [{"key": key, "value": f"{value:.3f}"} for key, value in state.items()
               if isinstance(value, float)]
    return {"timestamp": foxglove.time(when), "frame_id": "world", "id": name, "lifetime": foxglove.time(0),
            "frame_locked": False, "metadata": numbers, "cubes": [a_cube]}


class Scenes:
    """A topic of bodies; who is there no more is taken away."""

    def __init__(self):
        self.shown = set()

    def update(self, when, entities):
        now = {one["id"] for one in entities}
        gone = [{"timestamp": foxglove.time(when), "type": foxglove.MATCHING_ID, "id": name}
                for name in sorted(self.shown - now)]
        self.shown = now
        return {"deletions": gone, "entities": entities}


def messages(header, lines):
    """(topic, schema, time [ns], message), in order of time."""
    bodies = {body["id"]: body for body in header["actors"]}
    truth, knowledge = Scenes(), Scenes()
    out = []

    def actors(when, states, alpha):
        return [entity(when, state["id"],
                       cube(bodies[state["id"]]["kind"], bodies[state["id"]], state,
                            alpha * state.get("existence", 1.0)), state) for state in states]

    for line in lines:
        when = nanoseconds(line["t_s"])
        if line["type"] == "event":
            level = foxglove.WARNING if line["kind"] in ("trigger", "contact", "fault") else foxglove.INFO
            out.append(("/events", "foxglove.Log", when,
                        {"timestamp": foxglove.time(when), "level": level, "name": line["plane"],
                         "message": f"{line['kind']}: {line['text']}", "file": "", "line": 0}))
            continue
        ego = line["ego"]
        out.append(("/tf", "foxglove.FrameTransform", when,
                    {"timestamp": foxglove.time(when), "parent_frame_id": "world", "child_frame_id": "ego",
                     "translation": foxglove.vector(ego["x_m"], ego["y_m"]),
                     "rotation": foxglove.turn(ego["heading_deg"])}))
        there = [entity(when, "ego", cube("ego", header["ego"], ego, TRUE_ALPHA), ego)]
        there += actors(when, line["actors"], TRUE_ALPHA)
        out.append(("/scene", "foxglove.SceneUpdate", when, truth.update(when, there)))
        known = actors(when, line.get("perceived", {}).get("actors", []), PERCEIVED_ALPHA)
        if known or knowledge.shown:
            out.append(("/perceived", "foxglove.SceneUpdate", when, knowledge.update(when, known)))
    return sorted(out, key=lambda message: message[2])


def write(path, all_messages):
    from mcap.writer import Writer  # here, so that what goes into the file can be tested without it

    partial = path.with_name(path.name + ".partial")
    with open(partial, "wb") as stream:
        writer = Writer(stream)
        writer.start(library="saca trace_mcap")
        schemas = {name: writer.register_schema(name, "jsonschema", json.dumps({"title": name, **schema}).encode())
                   for name, schema in foxglove.SCHEMAS.items()}
        channels = {}
        for topic, schema, when, message in all_messages:
            if topic not in channels:
                channels[topic] = writer.register_channel(topic, "json", schemas[schema])
            writer.add_message(channels[topic], log_time=when, publish_time=when,
                               data=json.dumps(message).encode())
        writer.finish()
    os.replace(partial, path)


def main(trace, output):
    try:
        if os.path.exists(output) and os.path.samefile(trace, output):
            return f"trace_mcap: error: {output}: want another file than the trace"
        write(pathlib.Path(output), messages(*read(pathlib.Path(trace))))
    except (OSError, ValueError) as problem:
        return f"trace_mcap: error: {problem}"
    except (KeyError, TypeError, AttributeError) as problem:
        return f"trace_mcap: error: {trace}: not a whole trace: {problem!r}"
    return None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
