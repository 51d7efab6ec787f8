"""The messages of Foxglove that a trace is told in, with the parts of their JSON schemas that we use.

Foxglove knows them by their names; field for field: https://docs.foxglove.dev/docs/visualization/message-schemas
"""
import math


def record(**fields):
    return {"type": "object", "properties": fields}


def listing(items):
    return {"type": "array", "items": items}


NUMBER, TEXT, WHOLE, FLAG = ({"type": name} for name in ("number", "string", "integer", "boolean"))
TIME = record(sec=WHOLE, nsec=WHOLE)
VECTOR = record(x=NUMBER, y=NUMBER, z=NUMBER)
QUATERNION = record(x=NUMBER, y=NUMBER, z=NUMBER, w=NUMBER)
POSE = record(position=VECTOR, orientation=QUATERNION)
CUBE = record(pose=POSE, size=VECTOR, color=record(r=NUMBER, g=NUMBER, b=NUMBER, a=NUMBER))
PAIR = record(key=TEXT, value=TEXT)
ENTITY = record(timestamp=TIME, frame_id=TEXT, id=TEXT, lifetime=TIME, frame_locked=FLAG,
                metadata=listing(PAIR), cubes=listing(CUBE))
DELETION = record(timestamp=TIME, type=WHOLE, id=TEXT)
SCHEMAS = {
    "foxglove.SceneUpdate": record(deletions=listing(DELETION), entities=listing(ENTITY)),
    "foxglove.FrameTransform": record(timestamp=TIME, parent_frame_id=TEXT, child_frame_id=TEXT,
                                      translation=VECTOR, rotation=QUATERNION),
    "foxglove.Log": record(timestamp=TIME, level=WHOLE, message=TEXT, name=TEXT, file=TEXT, line=WHOLE),
}
MATCHING_ID = 0  # of a deletion
INFO, WARNING = 2, 3  # of a log


def time(nanoseconds):
    return {"sec": nanoseconds // 10**9, "nsec": nanoseconds % 10**9}


def vector(x, y, z=0.0):
    return {"x": x, "y": y, "z": z}


def turn(degrees):
    """About the vertical."""
    half = math.radians(degrees) / 2
    return {"x": 0.0, "y": 0.0, "z": math.sin(half), "w": math.cos(half)}
