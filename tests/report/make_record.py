"""Writes SYNTHETIC records (schema saca.record/1, docs/formats.md) for the test of the report page.

    make_record.py {contact,clear,empty,crowd,switched} FILE

Nobody measured or simulated these encounters: constant decelerations, lane changes as quintic
polynomials, boxes in the plane. They are plausible enough to look at, and every text in them says
that they are test data. Not to be quoted.
"""

import json
import math
import sys

STEP = 0.01  # of the motions [s]
FRAME = 0.02  # of the record [s]
EGO = {"length_m": 4.7, "width_m": 1.9, "centre_x_m": -0.1,
       "front_axle_x_m": 1.35, "rear_axle_x_m": -1.45, "track_m": 1.6}
NAMES = ["AEB", "AES-L", "AES-R", "ES-B-L", "ES-B-R", "T-D-L", "T-D-R", "NI"]
SIZES = {"car": (4.5, 1.8), "van": (5.4, 2.0), "truck": (11.5, 2.5), "motorcycle": (2.2, 0.8),
         "bicycle": (1.8, 0.6), "pedestrian": (0.5, 0.6), "obstacle": (2.0, 1.2)}
INTENTIONS = ["M", "LC", "RC", "FB", "LB", "RB"]
OF_WALKERS = ["M", "stop", "cross"]
T2, T1 = 5.5, 1.3


class Road:
    """The lane's centre line as an arc; poses along it are (s, d, heading against the lane)."""

    def __init__(self, **fields):
        self.fields = {"topology": "straight", "x_m": 0.0, "y_m": 0.0, "heading_deg": 0.0, "curvature_1pm": 0.0,
                       "lane_width_m": 3.5, "left_edge_m": 5.25, "right_edge_m": -3.0, "left_beyond": "barrier",
                       "right_beyond": "kerb", "oncoming_left": False, "oncoming_right": False, **fields}

    def to_world(self, s, d, heading=0.0):
        f = self.fields
        k, start = f["curvature_1pm"], math.radians(f["heading_deg"])
        turned = k * s
        x, y = (s, 0.0) if k == 0 else (math.sin(turned) / k, (1 - math.cos(turned)) / k)
        x, y = x - d * math.sin(turned), y + d * math.cos(turned)
        return (f["x_m"] + x * math.cos(start) - y * math.sin(start),
                f["y_m"] + x * math.sin(start) + y * math.cos(start), start + turned + heading)


def quintic(share):
    share = min(max(share, 0.0), 1.0)
    return share**3 * (10 - 15 * share + 6 * share**2)


def manoeuvre(policy, s, speed, deceleration, width):
    """(s, d, heading, speed) of the ego every STEP: braking, or a lane change of 1.5 s, or both."""
    side = {1: 1, 2: -1, 3: 1, 4: -1}.get(policy, 0)
    brake = {0: deceleration, 3: 0.5 * deceleration, 4: 0.5 * deceleration}.get(policy, 0.0)
    floor = speed / 2 if side else 0.0
    motion, old_d = [], 0.0
    for k in range(int(4.0 / STEP) + 1):
        t = k * STEP
        d = side * width * quintic(t / 1.5)
        v = max(floor, speed - brake * max(0.0, t - 0.1)) if brake else speed
        heading = math.atan2(d - old_d, v * STEP) if v > 0.1 else 0.0
        motion.append((s, d, heading, v))
        s, old_d = s + v * STEP, d
        if v <= 0.0:
            break
    return motion


def corners(x, y, heading, length, width, ahead=0.0):
    c, s = math.cos(heading), math.sin(heading)
    return [(x + a * c - b * s, y + a * s + b * c)
            for a, b in ((ahead + length / 2, width / 2), (ahead - length / 2, width / 2),
                         (ahead - length / 2, -width / 2), (ahead + length / 2, -width / 2))]


def local(point, x, y, heading):
    c, s = math.cos(heading), math.sin(heading)
    return ((point[0] - x) * c + (point[1] - y) * s, -(point[0] - x) * s + (point[1] - y) * c)


def gap(a, b):
    """Distance of two convex polygons by the separating axes through their corners and edges."""
    def to_edge(p, q, r):
        ex, ey = r[0] - q[0], r[1] - q[1]
        share = min(1.0, max(0.0, ((p[0] - q[0]) * ex + (p[1] - q[1]) * ey) / (ex * ex + ey * ey)))
        return math.hypot(p[0] - q[0] - share * ex, p[1] - q[1] - share * ey)

    def apart(p, q):
        for i, start in enumerate(p):
            end = p[(i + 1) % len(p)]
            normal = (start[1] - end[1], end[0] - start[0])
            side = [normal[0] * (c[0] - start[0]) + normal[1] * (c[1] - start[1]) for c in p]
            other = [normal[0] * (c[0] - start[0]) + normal[1] * (c[1] - start[1]) for c in q]
            if max(side) < min(other) or max(other) < min(side):
                return True
        return False

    if not apart(a, b) and not apart(b, a):
        return 0.0
    return min(min(to_edge(p, q[i], q[(i + 1) % len(q)]) for p in o for i in range(len(q)))
               for o, q in ((a, b), (b, a)))


def face_of(point, pose, length, width, ahead):
    a, b = local(point, *pose)
    a, b = (a - ahead) / (length / 2), b / (width / 2)
    if abs(a) >= abs(b):
        return "front" if a > 0 else "rear"
    return "left" if b > 0 else "right"


class Mover:
    """An actor in its lane: keeps its speed until `brake_at`, then brakes."""

    def __init__(self, name, s, d, speed, brake_at=1e9, deceleration=0.0, heading_deg=0.0):
        self.name, self.kind = name, name.rstrip("0123456789")
        self.length, self.width = SIZES[self.kind]
        self.s, self.d, self.speed = s, d, speed
        self.brake_at, self.deceleration, self.heading = brake_at, deceleration, math.radians(heading_deg)

    def at(self, t):
        before, after = min(t, self.brake_at), max(0.0, t - self.brake_at)
        if self.deceleration:
            after = min(after, self.speed / self.deceleration)
        way = self.speed * (before + after) - 0.5 * self.deceleration * after**2
        return (self.s + way * math.cos(self.heading), self.d + way * math.sin(self.heading), self.heading,
                self.speed - self.deceleration * after)


class Encounter:
    def __init__(self, road, movers, speed, grip):
        self.road, self.movers, self.speed, self.grip = road, movers, speed, grip
        self.deceleration = 9.0 * grip

    def conflict(self, s, v, t):
        """Time until the ego's front reaches the slower actor ahead in its lane."""
        times = [(a[0] - m.length / 2 - s - 2.25) / (v - a[3]) for m in self.movers for a in [m.at(t)]
                 if abs(a[1]) < 1.5 and a[0] > s and v - a[3] > 0.1]
        return min((c for c in times if 0 <= c < 10.0), default=None)

    def outcome(self, motion, start):
        """First contact along a motion, or the smallest gap."""
        smallest = None
        for k, (s, d, heading, v) in enumerate(motion):
            pose = self.road.to_world(s, d, heading)
            body = corners(*pose, EGO["length_m"], EGO["width_m"], EGO["centre_x_m"])
            for m in self.movers:
                a = m.at(start + k * STEP)
                if abs(a[0] - s) > 15:
                    continue
                other_pose = self.road.to_world(*a[:3])
                other = corners(*other_pose, m.length, m.width)
                distance = gap(body, other)
                if distance == 0.0:
                    inside = [p for p in other if abs(local(p, *pose)[0] - EGO["centre_x_m"]) <= 2.4
                              and abs(local(p, *pose)[1]) <= 1.0] or body[:1]
                    return k, self.contact(m, inside, pose, other_pose, v, a[3], start + k * STEP)
                smallest = distance if smallest is None else min(smallest, distance)
        return len(motion) - 1, {"contact": None, "collision_loss": 0.0, "harm": 0.0, "clearance_m": smallest}

    def contact(self, mover, points, pose, other_pose, v, other_v, time):
        p = [sum(c) / len(points) for c in zip(*points)]
        velocity = [v * math.cos(pose[2]) - other_v * math.cos(other_pose[2]),
                    v * math.sin(pose[2]) - other_v * math.sin(other_pose[2])]
        speed = math.hypot(*velocity)
        face = face_of(p, pose, EGO["length_m"], EGO["width_m"], EGO["centre_x_m"])
        factor = {"front": 0.35, "rear": 0.21}.get(face, 0.41)
        return {"contact": {"time_s": time, "with": mover.name, "ego_face": face,
                            "other_face": face_of(p, other_pose, mover.length, mover.width, 0.0),
                            "relative_speed_mps": speed, "x_m": p[0], "y_m": p[1],
                            "normal_deg": math.degrees(pose[2]) + {"front": 0, "left": 90, "right": -90, "rear": 180}[face],
                            "v_rel_x_mps": -velocity[0], "v_rel_y_mps": -velocity[1],
                            "ego_delta_v_mps": 0.55 * speed, "other_delta_v_mps": 0.6 * speed},
                "collision_loss": factor * speed, "harm": 2 / (1 + math.exp(4.457 - 0.177 * 0.6 * speed)),
                "clearance_m": 0.0}


def pose_fields(pose, speed):
    return {"x_m": pose[0], "y_m": pose[1], "heading_deg": math.degrees(pose[2]), "speed_mps": speed}


def refusal(policy, road):
    if policy in (5, 6):
        return f"{NAMES[policy]} needs a speed of 10 to 25 m/s ahead, is 9.00"
    if policy in (2, 4) and road.fields["right_edge_m"] > -road.fields["lane_width_m"]:
        return "no room: the right edge is 3.0 m from the lane's centre"
    return None


def futures(encounter, s, trigger):
    """What each of the eight policies ends in, begun at the trigger; with paths."""
    rows = []
    for policy, name in enumerate(NAMES):
        row = {"policy": policy, "name": name, "refusal": refusal(policy, encounter.road), "collision_loss": None,
               "harm": None, "clearance_m": None, "contact": None, "path": []}
        if row["refusal"] is None:
            motion = manoeuvre(policy, s, encounter.speed, encounter.deceleration, 3.5)
            end, outcome = encounter.outcome(motion, trigger)
            row.update(outcome)
            poses = [encounter.road.to_world(*m[:3]) for m in motion[:end + 1:5]]
            row["path"] = [[x, y, math.degrees(h)] for x, y, h in poses]
        rows.append(row)
    return rows


def facts_of(rows, speed):
    facts = []
    for row in rows:
        contact = row["contact"]
        text = row["refusal"] or (
            f"contact with {contact['with']} at {contact['relative_speed_mps']:.1f} m/s, {contact['ego_face']}" if contact
            else "nobody near" if row["clearance_m"] is None else f"clear by {row['clearance_m']:.1f} m")
        facts.append({**{k: v for k, v in row.items() if k != "path"}, "text": text,
                      "target_speed_mps": speed / 2 if row["policy"] in (3, 4) else None, "strength": None})
    return facts


def chances(policy, sharpness):
    weights = [sharpness if p == policy else 1.0 + 0.3 * math.sin(5 * p) for p in range(8)]
    return [w / sum(weights) for w in weights]


def preview(index, encounter, s, trigger, ready, policy, share, gate):
    movers = encounter.movers
    rows = futures(encounter, s, trigger)
    actors = []
    for n, m in enumerate(movers):
        intention = "FB" if m.deceleration and index != 1 else "M"
        weights = [4.0 if i == intention else 0.3 + 0.2 * ((n + k) % 3) for k, i in enumerate(INTENTIONS)]
        risk = max(0.0, 1.0 - 0.25 * n) if m.deceleration else max(0.05, 0.4 - 0.1 * n)
        actors.append({"id": m.name, "intention": intention,
                       "posterior": {i: w / sum(weights) for i, w in zip(INTENTIONS, weights)}, "risk": risk,
                       "risk_text": f"test data: needs {20 * risk:.1f} m of 20.0 m"})
    scene = {"ego": pose_fields(encounter.road.to_world(s - 0.5 - 0.4 * index, 0.0), encounter.speed),
             "actors": [{"id": m.name, **pose_fields(encounter.road.to_world(a[0] + 0.8 + 1.5 * index, *a[1:3]), a[3])}
                        for m in movers for a in [m.at(trigger)]]}
    lines = "\n".join(f"{f['policy']} {f['name']}: {f['text']}" for f in facts_of(rows, encounter.speed))
    prompt = (f"ego: {encounter.speed:.1f} m/s, straight, grip {encounter.grip} (synthetic test data)\n"
              + "\n".join(f"{m.name}: speed {m.at(trigger)[3]:.1f} m/s" for m in movers)
              + f"\nMore harm:\n{lines}\nno case is alike\n")
    asked = gate != "cache"
    return {"probability": share, "ready_s": ready, "scene": scene, "actors": actors,
            "facts": facts_of(rows, encounter.speed),
            "memory": {"case": None if gate == "reason" else 17, "similarity": {"reason": 0.31, "check": 0.78, "cache": 0.94}[gate],
                       "gate": gate},
            "prompt": prompt if asked else "",
            "reasoning": "Scenario Analysis (test data)\n1. The nearest threat is ahead in the ego's lane.\n"
                         f"2. {NAMES[policy]} is forecast: {rows[policy]['refusal'] or facts_of(rows, encounter.speed)[policy]['text']}.\n"
                         f"Response to user: {policy}" if asked else "",
            "truth": {"checked": 3, "score": 2 / 3 if index else 1.0,
                      "false": [{"text": "2. The left is blocked.", "why": "of the three policies to the left none is so",
                                 "load_bearing": index == 2}] if index else []} if asked else None,
            "answers": [{"t_s": ready - 0.9, "kind": "first", "probability": chances(policy, 1.6)},
                        {"t_s": ready - 0.2, "kind": "forced" if index else "ended", "probability": chances(policy, 9.0)}]
                       if asked else [],
            "check": {"passed": True, "text": f"test data: rollout of {NAMES[policy]} is no worse than AEB"} if gate != "cache" else None,
            "plan": {"policy": policy, "target_speed_mps": encounter.speed / 2 if policy in (3, 4) else None, "strength": None}}


def drive(encounter, policy):
    """Frames up to the trigger, then along the policy to its end; with T2 and T1."""
    frames, t2, trigger, motion, end, result = [], None, None, [], 0, None
    t, s = 0.0, 0.0
    while True:
        if trigger is None:
            state, yaw_rate = (s, 0.0, 0.0, encounter.speed), 0.0
            conflict = encounter.conflict(s, encounter.speed, t)
            if t2 is None and conflict is not None and conflict < T2:
                t2 = t
            if conflict is not None and conflict <= T1:
                trigger = t
                motion = manoeuvre(policy, s, encounter.speed, encounter.deceleration, 3.5)
                end, result = encounter.outcome(motion, trigger)
        if trigger is not None:
            k = min(round((t - trigger) / STEP), end)
            state, before = motion[k], motion[max(0, k - 1)]
            yaw_rate = (state[2] - before[2]) / STEP
            conflict = encounter.conflict(state[0], state[3], t) if abs(state[1]) < 1.5 else None
        pose = encounter.road.to_world(*state[:3])
        frames.append({"t_s": round(t, 3), "phase": "manoeuvre" if trigger is not None else "driving" if t2 is not None else "recorded",
                       "ego": {**pose_fields(pose, state[3]), "sideslip_deg": -0.15 * math.degrees(yaw_rate) * 0.3,
                               "yaw_rate_degps": math.degrees(yaw_rate),
                               "steering_deg": math.degrees(math.atan2(2.8 * yaw_rate, max(1.0, state[3])))},
                       "actors": [{"id": m.name, **pose_fields(encounter.road.to_world(*a[:3]), a[3])}
                                  for m in encounter.movers for a in [m.at(t)]],
                       "conflict_s": conflict})
        if trigger is not None and round((t - trigger) / STEP) >= end or t > 12:
            return frames, t2, trigger, s, result
        t = round(t + FRAME, 3)
        s = s + encounter.speed * FRAME if trigger is None else s


def intentions_of(encounter, frames):
    """Every 0.1 s: who brakes, or will within 1 s, is thought to; walkers stop or may cross."""
    def row(mover, t):
        brakes = 0.9 if t >= mover.brake_at and mover.at(t)[3] > 0.0 else 0.04
        walker = mover.kind in ("pedestrian", "bicycle")
        shares = [0.95 - brakes, brakes, 0.05] if walker else [0.9 - brakes, 0.06, 0.04, brakes, 0.0, 0.0]
        return " ".join(str(round(1000 * p)) for p in shares)

    times = [f["t_s"] for f in frames[::5]]
    return [{"actor": m.name, "of": OF_WALKERS if m.kind in ("pedestrian", "bicycle") else INTENTIONS, "times_s": list(times),
             "now_permille": [row(m, t) for t in times], "soon_permille": [row(m, t + 1.0) for t in times]}
            for m in encounter.movers if m.kind != "obstacle"]


def events_of(t2, trigger, previews, result, end, model):
    rows = [(t2, "thinking", "preview", f"time to conflict below {T2} s: three situations at the trigger are forecast"),
            (t2 + 0.01, "thinking", "risk", "car1 1.00"), (t2 + 0.02, "thinking", "intention", "car1 brakes (FB, 67 %)"),
            (t2 + 0.05, "thinking", "forecast", f"{len(previews)} situations")]
    for p in previews:
        memory = p["memory"]
        rows.append((t2 + 0.07, "thinking", "memory", f"similarity {memory['similarity']:.2f}: {memory['gate']}"))
        if p["answers"] and model:
            rows += [(t2 + 0.1, "thinking", "ask", "the model is asked"),
                     (p["answers"][0]["t_s"], "thinking", "first_answer", "answer possible"),
                     (p["answers"][1]["t_s"], "thinking", "answer", "the reply ended")]
        if p["check"]:
            rows.append((p["ready_s"] - 0.1, "thinking", "check", p["check"]["text"]))
        if p["plan"]:
            rows.append((p["ready_s"], "thinking", "cached", f"plan {NAMES[p['plan']['policy']]}"))
    rows += [(trigger, "reflex", "trigger", f"time to conflict {T1} s or less"),
             (trigger, "reflex", "match", "best preview 96 % alike" if previews else "no preview"),
             (trigger + 0.00002, "reflex", "execute", "the plan is carried out")]
    rows.append((end, "world", "contact", f"contact with {result['contact']['with']}") if result["contact"]
                else (end, "world", "rest", "the encounter is over, nobody was touched"))
    return [dict(zip(("t_s", "plane", "kind", "text"), r)) for r in sorted(rows, key=lambda r: r[0])]


def head(name, title, model, grip, road, movers, driver):
    return {"schema": "saca.record/1",
            "scenario": {"name": name, "title": title, "source": "SYNTHETIC TEST DATA, tests/report/make_record.py", "driver": driver},
            "pace": "lockstep", "model": model, "grip": grip, "thresholds": {"preview_s": T2, "trigger_s": T1},
            "road": road.fields, "ego": EGO,
            "actors": [{"id": m.name, "kind": m.kind, "shape": "ellipse" if m.kind == "pedestrian" else "box",
                        "length_m": m.length, "width_m": m.width} for m in movers]}


def played(name, title, encounter, policy, model, gates, driver):
    frames, t2, trigger, s, result = drive(encounter, policy)
    assert t2 is not None and trigger is not None
    shares = [0.62, 0.27, 0.11]
    previews = [preview(i, encounter, s, trigger, t2 + 1.3 + 0.15 * i, policy if i != 2 else 0, shares[i], g)
                for i, g in enumerate(gates)]
    rows = futures(encounter, s, trigger)
    able = [r for r in rows if r["refusal"] is None]
    best = min(able, key=lambda r: (round(r["harm"], 4), [7, 0, 1, 2, 3, 4, 5, 6].index(r["policy"])))
    source = {"cache": "memory", "check": "memory", "reason": "model"}[gates[0]] if gates else "fallback"
    contact = result["contact"]
    words = (f"{NAMES[policy]} could not avoid contact with {contact['with']}: {contact['ego_face']} at "
             f"{contact['relative_speed_mps']:.1f} m/s." if contact else
             f"{NAMES[policy]} avoided the contact and passed at {result['clearance_m']:.2f} m.")
    return {**head(name, title, model, encounter.grip, encounter.road, encounter.movers, driver),
            "frames": frames, "intentions": intentions_of(encounter, frames), "events": events_of(t2, trigger, previews, result, frames[-1]["t_s"], model != "off"),
            "previews": previews,
            "decision": {"policy": policy, "name": NAMES[policy],
                         "target_speed_mps": encounter.speed / 2 if policy in (3, 4) else None, "strength": None, "source": source,
                         "similarity": 0.96 if gates else None, "preview": 0 if gates else None, "time_s": trigger,
                         "text": "Test data: the first preview matched the scene at the trigger and its plan was carried out." if gates
                                 else "Test data: no preview was ready, so the rule-based fallback was carried out."},
            "result": {**result, "text": words}, "hindsight": rows, "best": best["policy"], "case": 18 if gates else None,
            "review": {"prompt": "# Review of an encounter that is over (synthetic test data)\n",
                       "text": f"1. {best['name']} would have been best.\n2. The left was blocked.",
                       "truth": {"checked": 2, "score": 0.5, "false": [
                           {"text": "2. The left was blocked.", "why": "of the three policies to the left none is so",
                            "load_bearing": False}]}} if gates else None,
            "timing": {"reflex_calls": len(frames), "reflex_us_p50": 3.1, "reflex_us_max": 18.4, "preview_s": 0.05,
                       "first_answer_s": 0.6 if gates else None, "answer_s": 1.3 if gates else None, "deadline_misses": 0}}


def with_draws(record, encounter):
    """The keys that a record may have besides: intervals over draws, the others' motion under each policy, a second contact."""
    start = record["decision"]["time_s"]
    for row in record["hindsight"]:
        if row["refusal"]:
            continue
        row.update({f"{key}_{end}": factor * row[key] for key in ("harm", "collision_loss") for end, factor in (("lo", 0.7), ("hi", 1.4))})
        row["others"] = [{"id": m.name, "path": [[x, y, math.degrees(h)] for k in range(len(row["path"])) for a in [m.at(start + 0.05 * k)]
                                                 for x, y, h in [encounter.road.to_world(*a[:3])]]} for m in encounter.movers]
        if row["contact"]:
            row["later"] = [{**row["contact"], "time_s": row["contact"]["time_s"] + 0.2, "with": "edge", "x_m": row["contact"]["x_m"] + 2.0}]
    return record


DANGER_RADIUS = 3.0


def with_danger_maps(record, actor):
    """Maps every quarter of a second up to 1 s after the trigger: V falls by 1 per metre, and is 0 on a circle about a place 0.5 m ahead of the
    actor's middle. Their frame looks back; one corner is not known."""
    first, step, columns, rows = (-8.5, -9.0), 1.0, 30, 19

    def row(r):
        at = [(first[0] + step * c, first[1] + step * r) for c in range(columns)]
        return " ".join("." if r == 0 and x < -6 else str(math.floor(10 * (DANGER_RADIUS - math.hypot(x, y)))) for x, y in at)

    start, end = record["events"][0]["t_s"], record["decision"]["time_s"] + 1.0
    record["danger_maps"] = {"actor": actor, "interval_s": 0.25, "maps": [
        {"t_s": start + 0.25 * k, "speed_mps": 20.0, "course_deg": 0.0, "x_m": 0.5, "y_m": 0.0, "heading_deg": 180.0, "first_x_m": first[0],
         "first_y_m": first[1], "step_m": step, "rows": [row(r) for r in range(rows)]} for k in range(int((end - start) / 0.25) + 1)]}
    return record


def contact():
    road = Road()
    movers = [Mover("car1", 39.0, 0.0, 20.0, 1.0, 2.3), Mover("van1", -26.0, 0.2, 20.5, 4.5, 5.0),
              Mover("car2", -55.0, 3.4, 23.0), Mover("pedestrian1", 96.0, -3.6, 1.3, heading_deg=180)]
    encounter = Encounter(road, movers, 20.0, 0.5)
    record = with_draws(played("synthetic_contact", "Test data: lead car brakes on a wet road", encounter, 0,
                               "synthetic stand-in for a language model", ["reason", "reason", "check"],
                               "Synthetic driver: braked 0.6 s after the trigger and struck car1 at 9.1 m/s."), encounter)
    return with_danger_maps(record, "car1")


def clear():
    road = Road(x_m=100.0, y_m=-40.0, heading_deg=35.0, curvature_1pm=0.004, left_beyond="trees", oncoming_left=True,
                right_edge_m=-1.75, right_beyond="unmarked")
    movers = [Mover("truck1", 44.0, 0.0, 16.0, 1.0, 2.6), Mover("motorcycle1", 330.0, 3.5, 14.0, heading_deg=180)]
    return played("synthetic_clear", "Test data: slowing truck in a bend", Encounter(road, movers, 16.0, 0.9), 3,
                  "synthetic stand-in for a language model", ["check", "reason", "cache"], None)


SHARES = [0.5, 0.25, 0.75, 0.0]  # of the ego's speed: what policies 3 and 4 brake to
STRENGTHS = 3               # of emergency braking: plans may come to be more than fourteen


def plans_at(speed, harm):
    """All plans at a speed; `harm` tells the expected harm of a policy's k-th plan, or None where it cannot be driven."""
    plans = []
    for policy, name in enumerate(NAMES):
        for k in range(STRENGTHS if policy == 0 else len(SHARES) if policy in (3, 4) else 1):
            value = harm(policy, k)
            plans.append({"policy": policy, "name": name, "target_speed_mps": SHARES[k] * speed if policy in (3, 4) else None,
                          "harm": value, "contact": None if value is None else min(1.0, 2.5 * value)})
    return plans


def verdict(t, speed, harm, under_way):
    """As SACA makes them: S reaches 0.002 above the least, or 3 % of what braking has above it."""
    plans = plans_at(speed, harm)
    least = min(p["harm"] for p in plans if p["harm"] is not None)
    going_on = None if under_way is None else {**next(p for p in plans if p["policy"] == under_way), "harm": harm(under_way, 0) + (0.01 if under_way else 0.0)}
    return {"t_s": t, "plans": plans, "under_way": going_on, "speaks_for": {k: min((p for p in plans if p["harm"] == least), key=lambda p: p["policy"])[k] for k in ("policy", "name", "target_speed_mps")},
            "admissible_harm": least + max(0.002, 0.03 * (plans[0]["harm"] - least))}


def hypotheses_at(encounter, t, begun, count=16):
    """`count` ways in which car1 brakes, all alike likely, and one in which the others go on; the van behind reacts."""
    times = [0.25 * k for k in range(17)]
    motions = []
    for k in range(count):
        paths = []
        for m in encounter.movers:
            if m.name == "van1":
                continue
            at = [m.at(t + s) for s in times]
            off = 0.12 * (k - (count - 1) / 2) if m.name == "car1" else 0.0
            poses = [encounter.road.to_world(a[0] + off * s, a[1] + 0.3 * off * s, a[2]) for a, s in zip(at, times)]
            paths.append({"id": m.name, **{key: " ".join(str(round(v)) for v in values) for key, values in (
                ("x_cm", [100 * p[0] for p in poses]), ("y_cm", [100 * p[1] for p in poses]), ("heading_deg", [math.degrees(p[2]) for p in poses]))}})
        motions.append({"probability": 1 / count, "paths": paths})
    return {"t_s": begun, "scene_s": t, "step_s": 0.25, "horizon_s": 4.0, "reacting": ["van1"], "motions": motions}


def with_verdicts(record, encounter):
    """Verdicts every 50 ms from 1 s before T1 to the end; braking harms ever more, and 0.5 s after T1 a braked swerve begins in its place."""
    t1 = record["decision"]["time_s"]
    change = round(t1 + 0.5, 3)

    def harm_at(t):
        late = max(0.0, t - t1)

        def harm(policy, k):
            if policy in (5, 6):
                return None
            return {0: 0.004 + 0.3 * late + 0.01 * k, 1: 0.12, 2: 0.4, 3: 0.05 + 0.02 * k, 4: 0.3 + 0.02 * k, 7: 0.7}[policy]
        return harm

    in_hand = []
    end = record["frames"][-1]["t_s"]
    for k in range(int((end - t1 + 1.0) / 0.05)):
        t = round(t1 - 1.0 + 0.05 * k, 3)
        under_way = None if t <= t1 else 0 if t <= change else 3
        speed = min(record["frames"], key=lambda f: abs(f["t_s"] - t))["ego"]["speed_mps"]
        in_hand.append({**verdict(t, speed, harm_at(t), under_way), "received_s": round(t + 0.02, 3), "by_atlas": False})
    decisive = [v for v in in_hand if v["received_s"] <= t1][-1]
    by_switch = [v for v in in_hand if v["received_s"] <= change][-1]
    new = next(p for p in by_switch["plans"] if p["policy"] == 3)
    record["decision"]["verdict"] = {key: decisive[key] for key in ("t_s", "plans", "under_way", "speaks_for", "admissible_harm")}
    record["switches"] = [{"t_s": change, **{key: new[key] for key in ("policy", "name", "target_speed_mps", "harm")}, "reason": "better by far",
                           "harm_before": by_switch["under_way"]["harm"], "text": "test data: braking is expected to harm more"}]
    record["events"] = sorted(record["events"] + [{"t_s": change, "plane": "reflex", "kind": "switch", "text": "better by far: test data"}], key=lambda e: e["t_s"])
    record["verdicts"] = {"in_hand": in_hand, "left_out": 0}
    record["hypotheses"] = [hypotheses_at(encounter, decisive["t_s"], t1), hypotheses_at(encounter, by_switch["t_s"], change, 1)]
    return record


def switched():
    road = Road()
    movers = [Mover("car1", 39.0, 0.0, 20.0, 1.0, 2.3), Mover("van1", -26.0, 0.2, 20.5, 4.5, 5.0), Mover("car2", 50.0, 3.4, 18.0)]
    encounter = Encounter(road, movers, 20.0, 0.5)
    return with_verdicts(played("synthetic_switched", "Test data: a swerve in place of braking", encounter, 0, "off", [], None), encounter)


def crowd():
    road = Road(topology="intersection", left_edge_m=12.0, right_edge_m=-9.0, left_beyond="kerb", right_beyond="trees")
    kinds = ["car", "van", "truck", "motorcycle", "bicycle", "pedestrian", "obstacle"]
    movers = [Mover("car1", 36.0, 0.0, 14.0, 1.0, 3.0)]
    for n in range(31):
        kind = kinds[n % 7]
        still = kind in ("obstacle", "pedestrian")
        movers.append(Mover(f"{kind}{n // 7 + 2}", -40.0 + 9.0 * n, (4.5, -4.5, 8.0, -7.5)[n % 4], 0.0 if still else 8.0 + n % 5))
    return played("synthetic_crowd", "Test data: 32 actors, model off", Encounter(road, movers, 14.0, 0.9), 0, "off", [], None)


def empty():
    return {**head("synthetic_empty", "Test data: nothing happens", "off", 0.9, Road(), [], None), "frames": [], "intentions": [], "events": [],
            "previews": [], "decision": None,
            "result": {"contact": None, "collision_loss": 0.0, "harm": 0.0, "clearance_m": None, "text": "Test data: nothing happened."},
            "hindsight": [], "best": None, "case": None, "review": None,
            "timing": {"reflex_calls": 0, "reflex_us_p50": None, "reflex_us_max": None, "preview_s": None,
                       "first_answer_s": None, "answer_s": None, "deadline_misses": 0}}


RECORDS = {"contact": contact, "clear": clear, "crowd": crowd, "empty": empty, "switched": switched}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in RECORDS:
        sys.exit(__doc__)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(RECORDS[sys.argv[1]](), file, allow_nan=False)
