"""The report page as a person gets it: in a headless Chromium, from records of make_record.py."""

import copy
import functools
import json
import math
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import make_record
from pages import FORMATS, HOSTILE, colour, contrast, keys, like, luminance, pixel, poisoned

KINDS = list(make_record.RECORDS)
RECORDS = {kind: make() for kind, make in make_record.RECORDS.items()}
PANELS = ["stage", "time", "decision", "driver", "verdicts", "futures", "result", "previews", "run"]


@pytest.fixture
def show(open_report):
    return functools.partial(open_report, "encounter")


def on_screen(page, x, y):
    """Where a point of W stands in the window, by the camera that the page states and our own arithmetic."""
    view = page.run("plan.last_view")
    box = page.run("(({left, top}) => ({left, top}))(by_id('plan').getBoundingClientRect())")
    c, s = math.cos(view["heading"]), math.sin(view["heading"])
    forward = (x - view["x"]) * c + (y - view["y"]) * s
    left = -(x - view["x"]) * s + (y - view["y"]) * c
    assert not page.run("plan.upright"), "forward is to the right in a wide window"
    return box["left"] + view["px"] + view["scale"] * forward, box["top"] + view["py"] - view["scale"] * left


def in_body(body, ahead, left):
    h = math.radians(body["heading_deg"])
    return (body["x_m"] + ahead * math.cos(h) - left * math.sin(h), body["y_m"] + ahead * math.sin(h) + left * math.cos(h))


def frame_at(record, t):
    return min(record["frames"], key=lambda f: abs(f["t_s"] - t))


# --- the test data -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_synthetic_records_use_the_keys_of_the_schema_and_say_what_they_are(kind):
    documented = set(re.findall(r'"(\w+)"', FORMATS.read_text(encoding="utf-8"))) | set(make_record.INTENTIONS)
    assert keys(RECORDS[kind]) <= documented
    assert "SYNTHETIC TEST DATA" in RECORDS[kind]["scenario"]["source"]


# --- loading -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_loads_without_errors_and_asks_for_nothing(show, kind):
    page = show(RECORDS[kind])
    assert page.problems == []
    assert [url.split("/")[-1] for url in page.requests] == ["report.html"]
    text = page.run("document.body.innerText")
    assert RECORDS[kind]["result"]["text"] in text
    for slip in ("undefined", "NaN", "[object", "null"):
        assert slip not in text
    for panel in PANELS:
        assert page.run(f"by_id('{panel}').getBoundingClientRect().height") > 40, panel


@pytest.mark.parametrize("key", sorted((set(RECORDS["contact"]) | set(RECORDS["switched"])) - {"schema"}))
def test_a_record_may_lack_any_part(show, key):
    for value in ("missing", None):
        record = copy.deepcopy(RECORDS["contact" if key in RECORDS["contact"] else "switched"])
        del record[key]
        if value is None:
            record[key] = None
        assert show(record).problems == [], f"{key} {value}"


@pytest.mark.parametrize("key", ["frames", "events", "actors", "previews", "switches", "hindsight", "intentions"])
def test_a_list_may_hold_what_is_no_entry(show, key):
    record = copy.deepcopy(RECORDS["contact" if key in RECORDS["contact"] else "switched"])
    record[key] = [*record[key], None, "text"]
    assert show(record).problems == []


def test_numbers_may_be_null(show):
    def without_numbers(value):
        if isinstance(value, dict):
            return {k: without_numbers(v) for k, v in value.items()}
        if isinstance(value, list):
            return [without_numbers(v) for v in value]
        return None if isinstance(value, float) else value

    record = copy.deepcopy(RECORDS["contact"])
    for key in ("previews", "decision", "result", "hindsight", "timing", "thresholds", "road", "ego", "actors"):
        record[key] = without_numbers(record[key])
    page = show(record)
    page.run("page.seek(record.end)")
    assert page.problems == []


def test_text_of_a_record_never_becomes_markup(show):
    page = show(poisoned(RECORDS["contact"], spared=("schema", "id", "with", "plane", "kind", "phase", "source", "gate", "shape")))
    assert page.problems == []
    assert page.run("by_id('title').textContent") == HOSTILE
    assert page.run("document.querySelectorAll('img').length") == 0
    assert page.run("document.querySelectorAll('script').length") == 3
    assert page.run("window.hit === undefined")


# --- what each panel says ------------------------------------------------------------------------


@pytest.mark.parametrize("kind", RECORDS)
def test_the_decision_is_told_in_short(show, kind):
    """As `saca explain` does, where the record has what that needs; else as it was told then."""
    page = show(RECORDS[kind])
    assert page.run("by_id('explanation').textContent") == "[]"
    if RECORDS[kind]["decision"]:
        assert RECORDS[kind]["decision"]["text"] in page.run("by_id('decision').textContent")
    words = page.run("by_id('short-words').textContent")
    assert "T1" in words and "FB brakes" in words
    record = copy.deepcopy(RECORDS[kind])
    record["decision"] = {"verdict": None, "by_atlas": False, "not_admissible": False, "target_speed_mps": None, **(record["decision"] or {})} if record["decision"] else None
    record.update(switches=[], driver=None, hindsight=[{**row, "text": "x"} for row in record["hindsight"]], result={**record["result"], "text": "y", "harm": 0.0})
    page = show(record)
    paragraphs = json.loads(page.run("by_id('explanation').textContent"))
    assert paragraphs[0]["about"] == "In short" and paragraphs[0]["sentences"]
    assert page.run("[...document.querySelectorAll('.in-short')].map((p) => p.textContent)") == paragraphs[0]["sentences"]
    assert page.run("document.querySelectorAll('.explanation h3').length") == len(paragraphs) - 1


def test_whom_it_was_clear_of_is_told(show):
    record = copy.deepcopy(RECORDS["clear"])
    record["result"]["nearest"] = {"to": "car9", "time_s": 5.4}
    record["hindsight"][0].update(contact=None, clearance_m=1.25, nearest={"to": "van8", "time_s": 5.0})
    page = show(record)
    assert "to car9 at 5.40" in page.run("by_id('tiles').textContent")
    assert "of van8" in page.run("by_id('futures').textContent")


def test_it_opens_on_the_likeliest_forecast_where_none_was_matched(show):
    record = copy.deepcopy(RECORDS["clear"])
    assert len(record["previews"]) > 1
    record["decision"]["preview"] = None
    for k, preview in enumerate(record["previews"]):
        preview["probability"] = 0.1 * (k + 1)
    page = show(record)
    last = len(record["previews"]) - 1
    assert page.run("document.querySelector('[role=tab][aria-selected=true]').id") == f"tab-{last}"
    assert page.run("by_id('forecast').value") == str(last)


def test_what_was_switched_later_is_not_called_carried_out(show):
    record = copy.deepcopy(RECORDS["switched"])
    record["best"] = record["decision"]["policy"]
    record["hindsight"][record["best"]]["harm"] = record["result"]["harm"]
    page = show(record)
    assert "with equal harm" in page.run("by_id('tiles').textContent")
    assert "begun first" in page.run("by_id('futures').textContent")
    record["switches"] = []
    assert "was carried out" in show(record).run("by_id('tiles').textContent")


def test_the_header_gives_decision_contact_harm_and_best(show):
    text = show(RECORDS["contact"]).run("by_id('tiles').innerText")
    contact = RECORDS["contact"]["result"]["contact"]
    assert "AEB" in text and "from the language model" in text
    assert f"{contact['relative_speed_mps']:.1f}\u00a0m/s" in text and "car1" in text
    assert f"{RECORDS['contact']['result']['harm']:.3f}" in text
    assert make_record.NAMES[RECORDS["contact"]["best"]] in text


def test_the_decision_shows_what_was_expected_of_every_plan_and_what_began_later(show):
    record = copy.deepcopy(RECORDS["contact"])
    decision = record["decision"]
    plan = {"policy": decision["policy"], "name": decision["name"], "target_speed_mps": decision["target_speed_mps"], "strength": decision["strength"]}
    decision["verdict"] = {"t_s": 1.0, "admissible_harm": 0.013, "plans": [
        {"policy": 7, "name": "NI", "target_speed_mps": None, "harm": 0.4, "contact": 0.75},
        {**plan, "harm": 0.01, "contact": 0.125},
        {"policy": 5, "name": "T-D-L", "target_speed_mps": None, "harm": None, "contact": None}]}
    record["switches"] = [{"t_s": 2.5, "policy": 0, "name": "AEB", "target_speed_mps": None, "strength": 0.45, "reason": "better by far",
                           "text": "<b>going on</b> harms more"}]
    page = show(record)
    rows = page.run("[...document.querySelectorAll('#decision tbody tr')].map((row) => [row.className, row.textContent])")
    assert [kind for kind, _ in rows] == ["chosen", "", "refused"]  # the least harmful first
    assert "admissible" in rows[0][1] and "carried out" in rows[0][1] and "0.0100" in rows[0][1]
    assert "admissible" not in rows[1][1] and "75" in rows[1][1] and "cannot be driven" in rows[2][1]
    text = page.run("document.querySelector('#decision').textContent")
    assert "0 AEB at 45 % of the grip" in text and "better by far: <b>going on</b>" in text  # text, not markup


def test_hindsight_lists_all_eight_with_reasons_for_the_refused(show):
    page = show(RECORDS["contact"])
    rows = page.run("[...document.querySelectorAll('#result tbody tr')].map(r => [r.className, r.innerText])")
    assert len(rows) == 8
    for (kind, text), truth in zip(rows, RECORDS["contact"]["hindsight"]):
        assert text.startswith(f"{truth['policy']} {truth['name']}")
        assert ("best" in text.split("\n")[0]) == (truth["policy"] == RECORDS["contact"]["best"])
        assert (kind == "chosen") == (truth["policy"] == RECORDS["contact"]["decision"]["policy"])
        if truth["refusal"]:
            assert truth["refusal"] in text
        else:
            assert f"{truth['harm']:.3f}" in text


def test_each_preview_shows_its_memory_answers_check_prompt_and_reasoning(show):
    page = show(RECORDS["contact"])
    for k, truth in enumerate(RECORDS["contact"]["previews"]):
        page.run(f"by_id('tab-{k}').click()")
        assert page.run("[...document.querySelectorAll('.preview')].map(p => !p.classList.contains('closed'))") == [i == k for i in range(3)]
        text = page.run(f"by_id('preview-{k}').textContent")
        for words in (truth["prompt"], truth["reasoning"], truth["check"]["text"], f"{100 * truth['probability']:.0f}\u00a0%",
                      f"{100 * truth['memory']['similarity']:.0f}\u00a0%", *(a["risk_text"] for a in truth["actors"]), *(f["text"] for f in truth["facts"])):
            assert words in text
        said = truth["truth"]
        assert f"{said['checked'] - len(said['false'])} of {said['checked']} statements that can be checked are true" in text
        for wrong in said["false"]:
            assert wrong["text"] in text and wrong["why"] in text
        assert ("the choice rests on it" in text) == any(wrong["load_bearing"] for wrong in said["false"])
        widths = page.run(f"[...document.querySelectorAll('#preview-{k} .step table tbody tr')].map(r => [...r.querySelectorAll('.bar-rail span')].map(b => parseFloat(b.style.width)))")
        for policy, row in enumerate(widths):
            assert row == pytest.approx([100 * a["probability"][policy] for a in truth["answers"]], abs=0.01)


def test_the_model_looks_back_where_it_did(show):
    text, review = show(RECORDS["contact"]).run("by_id('review').textContent"), RECORDS["contact"]["review"]
    for words in (review["text"], review["prompt"], "1 of 2 statements that can be checked are true", review["truth"]["false"][0]["why"]):
        assert words in text
    without = copy.deepcopy(RECORDS["contact"])
    without["review"] = None
    assert show(without).run("document.querySelectorAll('#review').length") == 0


def test_the_driver_panel_says_what_the_driver_did_or_that_nobody_knows(show):
    assert "struck car1 at 9.1 m/s" in show(RECORDS["contact"]).run("by_id('driver').innerText")
    assert "does not know" in show(RECORDS["clear"]).run("by_id('driver').innerText")


# --- pictures of what would have been ---------------------------------------------------------------


def future(page, policy):
    """Of one policy's picture: px per metre by its scale bar, and points of elements by class [px]."""
    return page.run(f"""(figure => {{
      const points = (e) => e.getAttribute('points').split(' ').map((p) => p.split(',').map(Number));
      const bar = points(figure.querySelector('.scale')), metres = parseFloat([...figure.querySelectorAll('text')].pop().textContent);
      return {{ scale: (bar[2][0] - bar[1][0]) / metres, trail: [...figure.querySelectorAll('.trail')].map(points),
        ego: [...figure.querySelectorAll('polygon.body.ego')].map(points), threats: [...figure.querySelectorAll('polygon.body.threat')].map(points),
        others: [...figure.querySelectorAll('.body.actor, .body.threat')].length, ghosts: figure.querySelectorAll('polygon.ghost.ego').length,
        stars: [...figure.querySelectorAll('.star')].length, words: figure.innerText }};
    }})(document.querySelectorAll('.future')[{policy}])""")


def middle(points):
    return [sum(c) / len(points) for c in zip(*points)]


@pytest.mark.parametrize("kind", ["contact", "clear", "crowd"])
def test_small_multiples_show_all_eight_to_one_scale(show, kind):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    shown = [future(page, policy) for policy in range(8)]
    assert page.run("document.querySelectorAll('.future').length") == 8
    for row, picture in zip(record["hindsight"], shown):
        assert picture["scale"] == pytest.approx(shown[0]["scale"], rel=1e-6)
        assert f"{row['policy']} {row['name']}" in picture["words"]
        assert len(picture["ego"]) == 1
        if row["refusal"]:
            assert row["refusal"] in picture["words"] and picture["ghosts"] == 0
            continue
        first, last = row["path"][0], row["path"][-1]
        way = math.dist(picture["trail"][0][0], picture["trail"][0][-1])
        assert way == pytest.approx(picture["scale"] * math.dist(first[:2], last[:2]), abs=0.3), "the way of the centre of mass"
        (a, b, c, _), ego = picture["ego"][0], record["ego"]
        assert math.dist(a, b) == pytest.approx(picture["scale"] * ego["length_m"], abs=0.3)
        assert math.dist(b, c) == pytest.approx(picture["scale"] * ego["width_m"], abs=0.3)
        assert picture["stars"] == (1 + len(row.get("later", [])) if row["contact"] else 0)


def test_the_lane_points_to_the_right_and_left_is_up(show):
    picture = future(show(RECORDS["clear"]), 3)  # a lane change to the left, on a road that heads 35 degrees and bends left
    (x0, y0), (x1, y1) = picture["trail"][0][0], picture["trail"][0][-1]
    assert x1 - x0 > 2 * (y0 - y1) > 0
    on_the_way = picture["trail"][0][1]
    assert abs(on_the_way[1] - y0) < 0.05 * (on_the_way[0] - x0) + 0.2, "begins along the lane"


def test_others_move_as_under_the_policy_where_the_record_says_so(show):
    record = copy.deepcopy(RECORDS["contact"])
    struck = future(show(record), 0)["threats"]
    assert len(struck) == 1
    for one in record["hindsight"][0]["others"]:
        if one["id"] == "car1":
            one["path"] = [[x, y + 2.0, heading] for x, y, heading in one["path"]]  # the road heads east: 2 m to the left
    moved = future(show(record), 0)
    assert middle(struck[0])[1] - middle(moved["threats"][0])[1] == pytest.approx(2.0 * moved["scale"], abs=0.3)
    for row in record["hindsight"]:
        row.pop("others", None)
    assert middle(future(show(record), 0)["threats"][0]) == pytest.approx(middle(struck[0]), abs=1.0), "else as in the frames"


def test_nobody_is_claimed_to_be_where_the_record_does_not_know(show):
    record = copy.deepcopy(RECORDS["contact"])
    assert show(record).run("document.querySelectorAll('.stale').length") == 0, "the others' paths are given"
    for row in record["hindsight"]:
        row.pop("others", None)
        row.pop("later", None)
    page, end = show(record), record["frames"][-1]["t_s"] - record["decision"]["time_s"]
    stale = page.run("[...document.querySelectorAll('.future')].map(f => f.querySelectorAll('.stale').length)")
    for row, count in zip(record["hindsight"], stale):
        assert (count > 0) == (0.05 * (len(row["path"]) - 1) > end + 0.05 and not row["refusal"])
    assert "Dashed" in page.run("by_id('futures').innerText")


def test_bars_and_whiskers_are_in_proportion(show):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    for chart, key in enumerate(("harm", "collision_loss")):
        most = max(row[f"{key}_hi"] for row in record["hindsight"] if not row["refusal"])
        rows = page.run(f"""[...document.querySelectorAll('.cost')[{chart}].querySelectorAll('.cost-row')].map((row) => ({{
          text: row.innerText, rail: row.querySelector('.cost-rail')?.clientWidth, bar: row.querySelector('.cost-bar')?.getBoundingClientRect().width,
          whisker: ((a, b) => a && [a.getBoundingClientRect().left - b.getBoundingClientRect().left, a.getBoundingClientRect().width])(row.querySelector('.whisker'), row.querySelector('.cost-rail')) }}))""")
        assert len(rows) == 8
        for row, shown in zip(record["hindsight"], rows):
            if row["refusal"]:
                assert "refused" in shown["text"] and shown.get("rail") is None
                continue
            assert shown["rail"] == rows[0]["rail"], "bars are compared over one length"
            assert shown["bar"] == pytest.approx(shown["rail"] * row[key] / most, abs=1)
            if row[key] > 0:
                assert shown["whisker"] == pytest.approx([shown["rail"] * row[f"{key}_lo"] / most, shown["rail"] * (row[f"{key}_hi"] - row[f"{key}_lo"]) / most], abs=1)
    assert show(RECORDS["clear"]).run("document.querySelectorAll('.whisker').length") == 0, "no intervals in that record"


def test_the_close_up_shows_faces_normal_and_relative_velocity(show):
    page, contact = show(RECORDS["contact"]), RECORDS["contact"]["result"]["contact"]
    assert (contact["ego_face"], contact["other_face"]) == ("front", "rear")
    seen = page.run("""(figure => {
      const line = (e) => ['x1', 'y1', 'x2', 'y2'].map((k) => Number(e.getAttribute(k)));
      const points = (e) => e.getAttribute('points').split(' ').map((p) => p.split(',').map(Number));
      return { normal: line(figure.querySelector('.arrow.normal')), velocity: line(figure.querySelector('.arrow.v-rel')), faces: [...figure.querySelectorAll('.face')].map(points),
        ego: points(figure.querySelector('.body.ego')), other: points(figure.querySelector('.body.threat')), text: figure.innerText + figure.textContent };
    })(document.querySelector('.close-up'))""")
    assert seen["normal"][2] > seen["normal"][0] + 30 and seen["normal"][3] == pytest.approx(seen["normal"][1], abs=1), "ahead, out of the front"
    assert seen["velocity"][2] < seen["velocity"][0] - 10, "the slower car comes towards the ego"
    assert middle(seen["ego"])[0] < middle(seen["faces"][0])[0] == pytest.approx(max(x for x, _ in seen["ego"]), abs=0.2)
    assert middle(seen["faces"][1])[0] == pytest.approx(min(x for x, _ in seen["other"]), abs=0.2)
    assert f"{contact['relative_speed_mps']:.1f}" in seen["text"] and "car1" in seen["text"]
    assert f"ego {contact['ego_delta_v_mps']:.1f}\u00a0m/s, car1 {contact['other_delta_v_mps']:.1f}\u00a0m/s" in seen["text"]


def test_a_close_up_needs_a_contact_and_draws_no_arrow_that_is_not_known(show):
    assert show(RECORDS["clear"]).run("document.querySelectorAll('.close-up').length") == 0
    record = copy.deepcopy(RECORDS["contact"])
    for key in ("normal_deg", "v_rel_x_mps"):
        del record["result"]["contact"][key]
    page = show(record)
    assert page.run("document.querySelectorAll('.close-up .body').length") == 2
    assert page.run("document.querySelectorAll('.close-up .arrow').length") == 0
    assert page.problems == []


def test_a_contact_with_the_edge_has_a_close_up_without_another_body(show):
    record = copy.deepcopy(RECORDS["contact"])
    record["result"]["contact"].update({"with": "edge", "other_face": None})
    page = show(record)
    assert page.run("document.querySelectorAll('.close-up .body').length") == 1
    assert page.problems == []


# --- time ----------------------------------------------------------------------------------------


def test_play_moves_on_at_the_chosen_rate_and_stops_at_the_end(show):
    page = show(RECORDS["contact"])
    page.run("page.seek(4)")
    for rate in ("0.25", "0.5", "1", "2"):
        t = page.run(f"by_id('rate').value = '{rate}'; page.t = 4; page.playing = true; page.step(1500, 1000); page.play(false); page.t")
        assert t == pytest.approx(4 + 0.5 * float(rate))
    assert page.run("by_id('rate').value = '2'; by_id('play').click(); by_id('play').textContent") == "Pause"
    page.run("new Promise(done => { const look = () => page.playing ? requestAnimationFrame(look) : done(1); look(); })")
    assert page.run("page.t") == pytest.approx(RECORDS["contact"]["frames"][-1]["t_s"])
    assert page.run("by_id('play').textContent") == "Play"
    assert page.problems == []


def test_keys_step_and_play(show):
    page = show(RECORDS["contact"])
    page.run("page.seek(4)")
    page.key("ArrowRight")
    assert page.run("page.t") == pytest.approx(4.05)
    page.run("by_id('play').focus()")
    page.key("ArrowLeft")
    page.key("ArrowLeft")
    page.run("document.activeElement.blur()")
    assert page.run("page.t") == pytest.approx(3.95)
    page.key(" ", "Space", " ")
    assert page.run("page.playing")
    page.key(" ", "Space", " ")
    assert not page.run("page.playing")


def test_scrubber_values_and_events_stay_together(show):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    trigger = record["decision"]["time_s"]
    assert page.run("page.t") == pytest.approx(trigger), "opens at the trigger"
    page.run("by_id('scrub').value = '1000'; by_id('scrub').dispatchEvent(new Event('input'))")
    assert page.run("page.t") == pytest.approx(record["frames"][-1]["t_s"])
    assert f"{record['frames'][-1]['ego']['speed_mps']:.1f}\u00a0m/s" in page.run("by_id('now').innerText")
    page.run("document.querySelector('.kind-trigger').click()")
    assert page.run("page.t") == pytest.approx(trigger, abs=1e-9)
    assert "T1 trigger" in page.run("by_id('caption').innerText")
    cursor = page.run("document.querySelector('.cursor').getBoundingClientRect().x + 1")
    dot = page.run("(b => b.x + b.width / 2)(document.querySelector('.kind-trigger .dot').getBoundingClientRect())")
    assert cursor == pytest.approx(dot, abs=1.5)


def test_the_time_line_shows_each_event_once_in_its_lane_without_overlap(show):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    page.run("by_id('window').hidden || time_line.whole || by_id('window').click()")
    for plane in ("reflex", "thinking", "world"):
        boxes = page.run(f"[...document.querySelectorAll('.lane.{plane} .event')].map(e => {{ const b = e.getBoundingClientRect(); return [b.left, b.right, b.top, e.title]; }})")
        assert len(boxes) == sum(e["plane"] == plane for e in record["events"])
        words = page.run(f"[...document.querySelectorAll('.lane.{plane} .word')].map(e => {{ const b = e.getBoundingClientRect(); return [b.left, b.right, b.top, b.bottom]; }})")
        for i, a in enumerate(words):
            for b in words[:i]:
                assert a[1] <= b[0] or b[1] <= a[0] or a[3] <= b[2] + 4 or b[3] <= a[2] + 4
        assert all(0 <= left and right <= 1280 for left, right, *_ in boxes)


# --- intentions ----------------------------------------------------------------------------------


def intention_rows(page):
    return page.run("[...document.querySelectorAll('.strip-intentions')].map(s => s.querySelector('.strip-name span').textContent)")


def test_each_road_user_has_a_row_of_intentions_and_obstacles_have_none(show):
    assert sorted(intention_rows(show(RECORDS["contact"]))) == ["car1", "car2", "pedestrian1", "van1"]
    crowd = intention_rows(show(RECORDS["crowd"]))
    assert sorted(crowd) == sorted(a["id"] for a in RECORDS["crowd"]["actors"] if a["kind"] != "obstacle")
    assert intention_rows(show(RECORDS["empty"])) == []


def test_rows_of_many_are_folded_until_they_are_asked_for(show):
    page = show(RECORDS["crowd"])
    shown = "[...document.querySelectorAll('.strip-intentions')].filter(s => s.offsetHeight > 0).length"
    assert page.run(shown) == 6
    page.run("by_id('all-intentions').click()")
    assert page.run(shown) == len(RECORDS["crowd"]["intentions"])
    assert page.run("by_id('all-intentions').getAttribute('aria-expanded')") == "true"


def test_intentions_are_as_high_as_they_are_likely(show):
    record = RECORDS["contact"]
    page = show(record, height=1800)  # all of it in the window
    seen = next(one for one in record["intentions"] if one["actor"] == "car1")
    k = seen["of"].index("FB")
    t = next(t for t, row in zip(seen["times_s"], seen["now_permille"]) if row.split()[k] == "900" and t > record["decision"]["time_s"] - 1)
    index = page.run("[...document.querySelectorAll('.strip-intentions .strip-name span:first-child')].findIndex(s => s.textContent === 'car1')")
    box = page.run(f"(({{left, top}}) => ({{left, top}}))(document.querySelectorAll('.strip-intentions svg')[{index}].getBoundingClientRect())")
    x = box["left"] + page.run(f"time_line.x({t + 0.05})")
    brakes, goes_on = colour(page, "intends-FB"), colour(page, "intends-M")
    page.run(f"page.seek({t - 2.0})")  # the cursor out of the way
    top = page.run(f"document.querySelectorAll('.strip-intentions svg')[{index}].getBoundingClientRect().top")
    # 34 px high, stacked from below: 90 % brake, then the rest; below it 1 s ahead.
    assert like(pixel(page, x, top + 34 - 0.85 * 34), brakes)
    assert not like(pixel(page, x, top + 34 - 0.95 * 34), brakes)
    assert like(pixel(page, x, top + 36 + 5), brakes)
    before = next(t for t, now, soon in zip(seen["times_s"], seen["now_permille"], seen["soon_permille"])
                  if now.split()[k] == "40" and soon.split()[k] == "900")
    page.run("by_id('window').hidden || time_line.whole || by_id('window').click()")
    x = box["left"] + page.run(f"time_line.x({before + 0.05})")
    top = page.run(f"document.querySelectorAll('.strip-intentions svg')[{index}].getBoundingClientRect().top")
    assert like(pixel(page, x, top + 10), goes_on), "not yet"
    assert like(pixel(page, x, top + 36 + 4), brakes), "but within a second"


def test_the_likeliest_intention_stands_in_words_at_the_cursor(show):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    seen = next(one for one in record["intentions"] if one["actor"] == "car1")
    value = "[...document.querySelectorAll('.strip-intentions')].find(s => s.innerText.startsWith('car1')).querySelector('.strip-value').textContent"
    for t, words in ((0.5, "goes on 86"), (2.0, "brakes 90")):
        page.run(f"page.seek({t})")
        assert page.run(value).replace("\u00a0", " ") == f"{words} %"
    page.run(f"page.seek({seen['times_s'][-1] + 5.0})")
    assert page.run("document.querySelector('.intention-word')") is not None
    assert "Intentions of car1: goes on from" in page.run(
        "[...document.querySelectorAll('.strip-intentions svg')].map(s => s.getAttribute('aria-label')).join()").replace("\u00a0", " ")


def test_the_legend_spells_out_the_intentions_that_there_are(show):
    words = show(RECORDS["contact"]).run("document.querySelector('.intention-legend').innerText")
    for word in ("goes on", "brakes and moves left", "stops", "crosses the lane"):
        assert word in words
    assert "stops" not in show(RECORDS["clear"]).run("document.querySelector('.intention-legend').innerText")


def test_intentions_that_do_not_fit_are_left_out(show):
    record = copy.deepcopy(RECORDS["contact"])
    one = record["intentions"][0]
    one["now_permille"][0], one["soon_permille"][1], one["times_s"][2] = "1000", None, None
    record["intentions"][1]["of"] = None
    page = show(record)
    assert page.problems == []
    assert page.run("record.intentions.map(one => one.times.length)") == [len(one["times_s"]) - 3] + [len(one["times_s"])] * 2


# --- the plan view -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind, t", [("contact", 4.0), ("clear", 5.9), ("crowd", 5.0)])
def test_the_ego_is_drawn_where_it_is_as_large_as_it_is(show, kind, t):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    page.run(f"plan.ghost_preview = null; plan.ghost_policies.clear(); page.seek({t})")
    page.settle()
    ego, blue = frame_at(record, t)["ego"], colour(page, "ego")
    size = record["ego"]
    half_length, half_width = size["length_m"] / 2, size["width_m"] / 2
    margin = 3.5 / page.run("plan.last_view.scale")  # the outline and a pixel [m]
    assert margin < 0.6
    inside = [(0, 0), (-0.3, 0.4), (half_length - margin, 0.75 * half_width), (half_length - margin, -0.75 * half_width),
              (-half_length + margin, 0.6 * half_width), (-half_length + margin, -0.6 * half_width)]
    outside = [(half_length + margin, 0.7 * half_width), (-half_length - margin, 0.6 * half_width), (-0.2, half_width + margin), (-0.2, -half_width - margin)]
    for ahead, left in inside:
        seen = pixel(page, *on_screen(page, *in_body(ego, size["centre_x_m"] + ahead, left)))
        assert like(seen, blue), f"{ahead:.2f} m ahead, {left:.2f} m left of the centre: {seen}"
    for ahead, left in outside:
        seen = pixel(page, *on_screen(page, *in_body(ego, size["centre_x_m"] + ahead, left)))
        assert not like(seen, blue, 40), f"{ahead:.2f} m ahead, {left:.2f} m left of the centre: {seen}"
    # The front is the end with the nose mark: the middle of the front third differs from the rear's.
    nose = pixel(page, *on_screen(page, *in_body(ego, size["centre_x_m"] + 0.72 * half_length, 0)))
    tail = pixel(page, *on_screen(page, *in_body(ego, size["centre_x_m"] - 0.5 * half_length, 0)))
    assert like(nose, colour(page, "halo"), 12) and like(tail, blue)


def test_the_road_bends_as_recorded(show):
    page, record = show(RECORDS["clear"]), RECORDS["clear"]
    page.run("plan.ghost_preview = null; plan.ghost_policies.clear(); page.seek(5.9)")
    page.settle()
    road, s = make_record.Road(**record["road"]), page.run("plan.last_view.s")
    edges = record["road"]["right_edge_m"], record["road"]["left_edge_m"]
    for ahead in (-10, 30):
        for d, name in ((edges[0] - 0.4, "ground"), (edges[0] + 0.8, "road"), (edges[1] - 0.8, "road"), (edges[1] + 0.15, "ground")):
            seen = pixel(page, *on_screen(page, *road.to_world(s + ahead, d)[:2]))
            assert like(seen, colour(page, name)), f"{ahead} m ahead, d = {d}: {seen}, want {name}"


def test_others_are_drawn_where_they_are(show):
    for kind, t, actor, name in (("clear", 5.9, "truck1", "threat"), ("crowd", 5.0, "car1", "actor"), ("crowd", 5.0, "van3", "actor")):
        page, record = show(RECORDS[kind]), RECORDS[kind]
        page.run(f"plan.ghost_preview = null; plan.ghost_policies.clear(); page.seek({t})")
        page.settle()
        body = next(a for a in frame_at(record, t)["actors"] if a["id"] == actor)
        assert like(pixel(page, *on_screen(page, *in_body(body, -0.6, 0.4))), colour(page, name)), actor


def test_the_contact_is_marked_from_its_time_on(show):
    page, contact = show(RECORDS["contact"]), RECORDS["contact"]["result"]["contact"]
    for t, marked in ((contact["time_s"] - 0.05, False), (contact["time_s"], True)):
        page.run(f"page.seek({t})")
        page.settle()
        assert like(pixel(page, *on_screen(page, contact["x_m"], contact["y_m"])), colour(page, "contact")) == marked, t


def test_a_contact_after_the_last_frame_is_marked_too(show):
    record = copy.deepcopy(RECORDS["contact"])
    record["result"]["contact"]["time_s"] += 0.013
    page = show(record)
    page.run("page.seek(record.end)")
    page.settle()
    contact = record["result"]["contact"]
    assert like(pixel(page, *on_screen(page, contact["x_m"], contact["y_m"])), colour(page, "contact"))


def test_ghosts_come_and_go(show):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    page.run(f"plan.ghost_policies.clear(); page.seek({record['decision']['time_s'] + 1.0})")
    path = next(row["path"] for row in record["hindsight"] if row["policy"] == 3)
    x, y, heading = path[20]  # 1 s after the trigger
    rear = in_body({"x_m": x, "y_m": y, "heading_deg": heading}, record["ego"]["centre_x_m"] - record["ego"]["length_m"] / 2, 0)

    def green_near():
        page.settle()
        px, py = on_screen(page, *rear)
        return sum(like(p, colour(page, "hindsight"), 30) for row in page.pixels(round(px) - 3, round(py) - 12, 7, 25) for p in row)

    assert green_near() == 0
    page.run("[...document.querySelectorAll('.chip')].find(c => c.textContent === 'ES-B-L').click()")
    assert green_near() >= 8, "the rear edge of the ghost, dashed"
    page.run("[...document.querySelectorAll('.chip')].find(c => c.textContent === 'ES-B-L').click()")
    assert green_near() == 0


def danger_beside(page, record, t):
    """What the map adds to a line from 0.5 m ahead of car1's middle to its right, where no name is: { metres: (red, green, blue) }."""
    body = next(a for a in frame_at(record, t)["actors"] if a["id"] == "car1")

    def line():
        page.settle()
        points = {d: on_screen(page, *in_body(body, 0.5, -d)) for d in (k / 10 for k in range(12, 85))}
        x, top = round(points[1.2][0]), round(points[1.2][1])
        column = page.pixels(x, top, 1, round(points[8.4][1]) - top + 1)  # the road runs to the right
        return {d: column[round(y) - top][0] for d, (_, y) in points.items()}

    page.run(f"page.seek({t})")
    shown = line()
    page.run("by_id('danger-switch').click()")
    hidden = line()
    page.run("by_id('danger-switch').click()")
    assert line() == shown
    return {d: tuple(p - q for p, q in zip(shown[d], hidden[d])) for d in shown}


@pytest.mark.parametrize("later", [0.0, 0.2])
def test_the_danger_map_is_red_where_unsafe_and_moves_with_its_actor(show, later):
    page, record = show(RECORDS["contact"]), RECORDS["contact"]
    radius, given = make_record.DANGER_RADIUS, record["danger_maps"]["maps"]
    assert page.problems == []
    t = round((given[8]["t_s"] + later) / 0.02) * 0.02
    page.run(f"page.seek({t}); plan.zoom *= 13 / plan.last_view.scale; page.show()")  # 8.4 m are in the picture
    for d, (red, _, blue) in danger_beside(page, record, t).items():
        if d < radius - 0.3:
            assert red > blue + 25, d
        elif radius + 0.3 < d < radius + 2.5:
            assert blue > red + 5, d
        elif d > radius + 5.3:  # where there is room to spare nothing is drawn
            assert (red, blue) == (0, 0), d
    after = given[-1]["t_s"] + 1.0
    if after < record["frames"][-1]["t_s"]:
        assert all(difference == (0, 0, 0) for difference in danger_beside(page, record, after).values())


def test_the_danger_map_says_what_it_is(show):
    page = show(RECORDS["contact"])
    label = "by_id('danger-switch').closest('label').innerText"
    assert "red = no evasion avoids car1" in page.run(label)
    # V of the ego's own place, by the record's own rule, turned half round: the map looks back.
    record = RECORDS["contact"]
    frame = frame_at(record, record["danger_maps"]["maps"][4]["t_s"])
    body = next(a for a in frame["actors"] if a["id"] == "car1")
    centre = in_body(body, 0.5, 0)
    p = in_body(body, -10.0, 2.0)
    value = page.run(f"plan.danger.value(frame_at(record, {frame['t_s']}), {frame['t_s']}, {{x_m: {p[0]}, y_m: {p[1]}}})")
    assert abs(value - (make_record.DANGER_RADIUS - math.dist(p, centre))) < 0.35  # rounded down, nearest of four dots a metre
    assert not show(RECORDS["clear"]).run("Boolean(by_id('danger-switch'))"), "nothing to switch"


# --- verdicts over time --------------------------------------------------------------------------


def curve(page, selector):
    """Points of the curves that a selector finds, as [s, expected harm], by the chart's own frame and our arithmetic: a root scale from 0."""
    frame = page.run("(({from, to, top, above, inner, plot}) => ({from, to, top, above, inner, plot}))(verdict_chart)")
    paths = page.run(f"[...document.querySelectorAll('#verdicts {selector}')].map((p) => p.getAttribute('d'))")
    return [[(frame["from"] + (float(x) - 44) / frame["plot"] * (frame["to"] - frame["from"]),
              frame["top"] * (1 - (float(y) - frame["above"]) / frame["inner"]) ** 2)
             for x, y in re.findall(r"[ML]([-0-9.]+) ([-0-9.]+)", d)] for d in paths]


def harm_at(points, t):
    return min(points, key=lambda p: abs(p[0] - t))[1]


def of_policy(verdict, policy, k=0):
    return [plan for plan in verdict["plans"] if plan["policy"] == policy][k]


def test_each_plan_has_a_curve_of_its_expected_harm(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    verdicts = record["verdicts"]["in_hand"]
    plans = len(verdicts[0]["plans"])
    assert plans > 14, "more plans than there are today"
    assert page.run("document.querySelectorAll('.verdict-track .verdict-line[d]').length") >= plans
    (braking,) = curve(page, ".verdict-track .verdict-line.aeb")
    # Half a pixel at the steepest: the scale is 230 px high.
    for verdict in verdicts[::7]:
        assert harm_at(braking, verdict["t_s"]) == pytest.approx(of_policy(verdict, 0)["harm"], abs=0.006)
    (least,) = curve(page, ".verdict-track .verdict-line.least")
    (edge,) = curve(page, ".verdict-edge")
    for verdict in verdicts[::7]:
        assert harm_at(least, verdict["t_s"]) == pytest.approx(min(p["harm"] for p in verdict["plans"] if p["harm"] is not None), abs=0.006)
        assert harm_at(edge, verdict["t_s"]) == pytest.approx(verdict["admissible_harm"], abs=0.006)


def test_what_is_carried_out_is_followed_through_the_switch(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    t1, change = record["decision"]["time_s"], record["switches"][0]["t_s"]
    before, after = curve(page, ".verdict-track .verdict-line.carried")
    for verdict in record["verdicts"]["in_hand"]:
        if t1 < verdict["t_s"] <= change:
            assert harm_at(before, verdict["t_s"]) == pytest.approx(verdict["under_way"]["harm"], abs=0.006)
        elif verdict["t_s"] > change:
            assert harm_at(after, verdict["t_s"]) == pytest.approx(verdict["under_way"]["harm"], abs=0.006)
    assert before[0][0] < t1 < after[0][0] < change + 0.01 and max(t for t, _ in after) > change + 0.4


def test_t1_and_each_switch_are_marked_with_their_reason(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    marks = page.run("""[...document.querySelectorAll('.verdict-mark')].map((m) => [m.querySelector('text').textContent,
      Number(m.querySelector('line').getAttribute('x1')), verdict_chart.x(record.begun.find((b) => m.textContent.includes(b.name)).t_s)])""")
    assert [text for text, *_ in marks] == ["T1: AEB", "ES-B-L, better by far"]
    for _, x, wanted in marks:
        assert x == pytest.approx(wanted, abs=0.1)
    boxes = page.run("[...document.querySelectorAll('.verdict-mark text')].map((e) => { const b = e.getBoundingClientRect(); return [b.left, b.right, b.top, b.bottom]; })")
    assert boxes[0][1] <= boxes[1][0] or boxes[0][3] <= boxes[1][2] + 2, "names do not cover one another"
    words = page.run("document.querySelector('.begun').innerText").replace("\u00a0", " ")
    assert "T1 +0.50 s" in words and "better by far" in words and f"{record['switches'][0]['harm']:.4f}" in words
    assert "ES-B-L" in page.run(f"page.seek({record['switches'][0]['t_s'] + 0.1}); by_id('phase').textContent")
    assert "AEB" in page.run(f"page.seek({record['decision']['time_s'] + 0.1}); by_id('phase').textContent")


def test_a_plan_is_named_where_it_is_pointed_at(show):
    page, record = show(RECORDS["switched"], height=2600), RECORDS["switched"]
    verdict = record["verdicts"]["in_hand"][9]
    plan = of_policy(verdict, 4, 2)
    x, y = page.run(f"""(({{left, top}}) => [left + verdict_chart.x({verdict['t_s']}), top + verdict_chart.y({plan['harm']})])(document.querySelector('.verdict-track svg').getBoundingClientRect())""")
    assert page.run("document.querySelectorAll('.verdict-line.hot').length") == 0
    page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y + 1)
    page.settle()
    words = page.run("document.querySelector('.verdict-spot').textContent").replace("\u00a0", " ")
    assert words == f"4 ES-B-R to {plan['target_speed_mps']:.1f} m/s: {plan['harm']:.4f}, contact {100 * plan['contact']:.0f} %"
    assert page.run("document.querySelectorAll('.verdict-line.hot').length") == 1
    page.call("Input.dispatchMouseEvent", type="mouseMoved", x=5, y=5)
    page.settle()
    assert page.run("document.querySelectorAll('.verdict-line.hot').length") == 0


def test_the_cursor_of_the_verdicts_is_that_of_the_page(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    verdict = record["verdicts"]["in_hand"][25]
    page.run(f"page.seek({verdict['t_s'] + 0.001})")
    assert page.run("Number(document.querySelector('.verdict-cursor').getAttribute('x1'))") == pytest.approx(page.run(f"verdict_chart.x({verdict['t_s']})"), abs=1)
    words = page.run("document.querySelector('.verdict-readout').innerText").replace("\u00a0", " ")
    inside = [p for p in verdict["plans"] if p["harm"] is not None and p["harm"] <= verdict["admissible_harm"]]
    assert f"AEB {of_policy(verdict, 0)['harm']:.4f}" in words and f"{verdict['under_way']['harm']:.4f}" in words
    assert f"{len(inside)} of {len(verdict['plans'])} plans" in words and f"speaks for {verdict['speaks_for']['policy']} {verdict['speaks_for']['name']}" in words
    page.run("document.querySelector('.verdict-track').scrollIntoView()")
    x, y = page.run(f"""(({{left, top}}) => [left + verdict_chart.x({record['verdicts']['in_hand'][5]['t_s']}), top + 60])(document.querySelector('.verdict-track svg').getBoundingClientRect())""")
    for kind in ("mousePressed", "mouseReleased"):
        page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
    page.settle()
    assert page.run("page.t") == pytest.approx(record["verdicts"]["in_hand"][5]["t_s"], abs=0.01)


def test_the_verdicts_are_told_in_words_too(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    label = page.run("document.querySelector('.verdict-track svg').getAttribute('aria-label')").replace("\u00a0", " ")
    assert f"{len(record['verdicts']['in_hand'])} verdicts" in label and "better by far" in label
    rows = page.run("[...document.querySelectorAll('#verdicts table')].map((t) => [...t.querySelectorAll('tbody tr')].map((r) => r.textContent))")
    assert len(rows) == 2, "all plans at the switch, and the verdicts over time"
    assert len(rows[0]) == len(record["verdicts"]["in_hand"][0]["plans"])
    over_time = rows[1]
    assert sum("begun by it" in row for row in over_time) == 2
    assert len(over_time) >= len(record["verdicts"]["in_hand"]) * 0.05 / 0.25


def test_a_record_without_verdicts_says_so_in_one_sentence(show):
    for record in (RECORDS["contact"], {**RECORDS["contact"], "verdicts": {"in_hand": [], "left_out": 0}, "hypotheses": []}):
        page = show(record)
        assert page.problems == []
        assert page.run("by_id('verdicts').innerText.split('\\n').slice(1).filter(Boolean)") == ["This record holds no verdicts over time."]
        assert page.run("document.querySelectorAll('#hypotheses, .swatch.hypothesis').length") == 0


@pytest.mark.parametrize("damage", [
    lambda r: r.update(verdicts=None, hypotheses=None), lambda r: r.update(verdicts=[1, 2], hypotheses="x"),
    lambda r: r["verdicts"].update(in_hand="x", left_out="x"), lambda r: r["decision"].update(verdict="x"), lambda r: r.update(switches=[None, 3, {}])])
def test_damaged_verdicts_do_not_stop_the_page(show, damage):
    record = copy.deepcopy(RECORDS["switched"])
    damage(record)
    page = show(record)
    page.run("page.seek(record.end)")
    assert page.problems == []
    assert "undefined" not in page.run("document.body.innerText")


def test_verdicts_and_hypotheses_that_do_not_fit_are_left_out_and_counted(show):
    record = copy.deepcopy(RECORDS["switched"])
    verdicts = record["verdicts"]["in_hand"]
    verdicts[3]["plans"], verdicts[4]["t_s"], verdicts[5]["plans"][2] = None, "x", None
    verdicts[6]["plans"][1]["harm"], verdicts[7]["admissible_harm"], verdicts[8]["under_way"] = "x", None, 7
    record["hypotheses"][0]["motions"][0]["paths"][0]["x_cm"] = "1 2 x"
    record["hypotheses"][0]["motions"][1]["probability"] = None
    record["hypotheses"][0]["motions"][2]["paths"][1]["y_cm"] = None
    page = show(record)
    assert page.problems == []
    assert page.run("record.verdicts.all.length") == len(verdicts) - 3
    assert "3 of the record's verdicts cannot be read" in page.run("by_id('verdicts').innerText")
    motions = record["hypotheses"][0]["motions"]
    assert page.run("record.hypotheses[0].motions.map((m) => m.paths.length)") == [len(motions[0]["paths"]) - 1, len(motions[2]["paths"]) - 1] + [len(m["paths"]) for m in motions[3:]]
    page.run("show_hypotheses(0)")
    assert page.problems == []


def test_a_record_that_leaves_verdicts_out_says_how_many(show):
    record = copy.deepcopy(RECORDS["switched"])
    record["verdicts"]["left_out"] = 31
    assert "31 verdicts" in show(record).run("by_id('verdicts').innerText")


# --- hypotheses ----------------------------------------------------------------------------------


def hypothesis_ink(page, x, y):
    """How far the hypotheses change the picture at a place of W: the sum over the three colours."""
    page.settle()
    shown = pixel(page, *on_screen(page, x, y))
    page.run("plan.kept = plan.hypotheses.shown; plan.hypotheses.shown = null; page.show()")
    page.settle()
    plain = pixel(page, *on_screen(page, x, y))
    page.run("plan.hypotheses.shown = plan.kept; page.show()")
    return sum(abs(a - b) for a, b in zip(shown, plain))


def test_hypotheses_are_stepped_through_and_put_the_page_to_their_instant(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    assert page.run("plan.hypotheses.shown") is None
    for wanted in (0, 1, 0):
        page.run("by_id('hypotheses-forth').click()")
        assert page.run("plan.hypotheses.shown") == wanted
        assert page.run("page.t") == pytest.approx(record["hypotheses"][wanted]["t_s"])
        words = page.run("by_id('hypotheses-words').textContent")
        assert f"{len(record['hypotheses'][wanted]['motions'])} way" in words and "van1" in words
    page.run("by_id('hypotheses-back').click()")
    assert page.run("by_id('hypotheses').value") == "1"
    page.run("by_id('hypotheses').value = ''; by_id('hypotheses').dispatchEvent(new Event('change'))")
    assert page.run("plan.hypotheses.shown") is None
    page.run("document.querySelectorAll('.begun button')[1].click()")
    assert page.run("plan.hypotheses.shown") == 1
    assert page.problems == []


def test_hypotheses_are_drawn_where_they_are_and_darker_where_likelier(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    ink = []
    for k in (0, 1):
        page.run(f"by_id('danger-switch')?.click(); plan.ghost_policies.clear(); plan.ghost_preview = null; show_hypotheses({k})")
        given = record["hypotheses"][k]
        motion = given["motions"][0]
        path = next(p for p in motion["paths"] if p["id"] == "car1")
        at = [(float(x) / 100, float(y) / 100) for x, y in zip(path["x_cm"].split(), path["y_cm"].split())]
        place = at[8]  # 2 s on: on the way, away from the bodies of now
        ink.append(hypothesis_ink(page, *place))
        x, y = place
        assert hypothesis_ink(page, x, y + 3.0) == 0, "nothing a lane aside"
    assert 15 < ink[0] < ink[1], "one of sixteen is fainter than one that is sure"


def test_opacity_grows_with_probability_and_draws_that_agree_add_up(show):
    page = show(RECORDS["switched"])
    shades = page.run("[1 / 64, 1 / 16, 0.25, 1].map((p) => HypothesisLayer.opacity(p))")
    assert shades == sorted(shades) and shades[0] > 0 and shades[-1] < 1
    assert 1 - (1 - shades[1]) ** 16 == pytest.approx(shades[-1], abs=1e-9)


def test_hypotheses_go_on_with_the_time_and_end_with_their_horizon(show):
    page, record = show(RECORDS["switched"]), RECORDS["switched"]
    page.run("show_hypotheses(1)")
    given = record["hypotheses"][1]
    path = "record.hypotheses[1].motions[0].paths.find((p) => p.id === 'car1')"
    for since in (0.0, 0.6, 3.9):
        x = page.run(f"plan.hypotheses.pose(record.hypotheses[1], {path}, {since}).x_m")
        row = [float(v) / 100 for v in next(p for p in given["motions"][0]["paths"] if p["id"] == "car1")["x_cm"].split()]
        k = int(since / 0.25)
        assert x == pytest.approx(row[k] + (since / 0.25 - k) * (row[k + 1] - row[k]), abs=1e-9)
    assert page.run(f"plan.hypotheses.pose(record.hypotheses[1], {path}, 4.1)") is None
    assert page.run(f"plan.hypotheses.pose(record.hypotheses[1], {path}, -0.1)") is None


# --- appearance ----------------------------------------------------------------------------------


def test_dark_and_light_by_button_both_with_readable_text(show):
    page = show(RECORDS["contact"])
    seen = {}
    for _ in range(2):
        dark = page.run("is_dark()")
        seen[dark] = pixel(page, 4, 4)
        for ink, paper in (("ink", "panel"), ("ink", "bg"), ("soft", "panel"), ("soft", "bg"), ("accent", "panel"), ("on-accent", "accent"),
                           ("bad", "panel"), ("good", "panel"), ("bad", "strong-bg"), ("good", "strong-bg"), ("soft", "strong-bg"),
                           ("good", "good-bg"), ("bad", "bad-bg"), ("warn", "warn-bg"), ("strong", "strong-bg"),
                           ("reflex", "panel"), ("thinking", "panel"), ("threat-line", "panel"), ("hypothesis", "panel")):
            assert contrast(colour(page, ink), colour(page, paper)) >= 4.5, f"{ink} on {paper}, {'dark' if dark else 'light'}"
        page.run("by_id('theme').click()")
        page.settle()
    assert luminance(seen[True]) < 0.05 < 0.7 < luminance(seen[False])
    assert page.problems == []


def test_the_dark_theme_of_the_system_is_taken_up(show):
    page = show(RECORDS["contact"])
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    page.settle()
    try:
        assert luminance(pixel(page, 4, 4)) < 0.05
        box = page.run("(({left, top}) => [left, top])(by_id('plan').getBoundingClientRect())")
        assert like(pixel(page, box[0] + 300, box[1] + 8), colour(page, "ground")), "the picture follows the theme"
    finally:
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])


@pytest.mark.parametrize("kind", KINDS)
def test_fits_a_telephone(show, kind):
    page = show(RECORDS[kind], 390, 844)
    assert page.problems == []
    assert page.run("document.documentElement.scrollWidth") <= 390
    assert page.run("plan.upright"), "forward is up where there is more height than width"


def test_paper_shows_all_previews_and_no_buttons(show):
    page = show(RECORDS["contact"])
    page.call("Emulation.setEmulatedMedia", media="print")
    try:
        assert page.run("[...document.querySelectorAll('.preview')].every(p => p.offsetHeight > 200)")
        assert page.run("[...document.querySelectorAll('button')].filter(b => b.offsetHeight && !b.matches('.event, .link')).length") == 0
    finally:
        page.call("Emulation.setEmulatedMedia", media="")
    assert page.problems == []


def test_printing_is_light_unfolds_all_and_leaves_no_trace(show):
    page = show(RECORDS["contact"])
    page.run("by_id('theme').click()")
    state = "[is_dark(), document.querySelectorAll('details[open]').length, plan.width, time_line.width]"
    before = page.run(state)
    page.run("window.dispatchEvent(new Event('beforeprint'))")
    dark, unfolded, *_ = page.run(state)
    assert not dark and unfolded == page.run("document.querySelectorAll('details').length")
    assert page.run("document.querySelector('main').clientWidth") == 1040, "what A4 holds across"
    page.run("window.dispatchEvent(new Event('afterprint'))")
    page.settle()
    assert page.run(state) == before and before[0]


def test_whatever_can_be_pressed_is_a_control_with_a_name(show):
    page = show(RECORDS["contact"])
    assert page.run("[...document.querySelectorAll('button, select, input')].filter(b => !(b.textContent.trim() || b.getAttribute('aria-label') || b.closest('label'))).length") == 0
    assert page.run("document.querySelectorAll('[onclick], div[role=button], span[role=button]').length") == 0
    assert page.run("[...document.querySelectorAll('h1')].length") == 1


if __name__ == "__main__":
    sys.exit(pytest.main([__file__, "-q"]))
