"""The page of a manoeuvre as a person gets it: in a headless Chromium, from records of make_drive.py."""

import copy
import functools
import math
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import make_drive
from pages import FORMATS, HOSTILE, colour, contrast, keys, like, luminance, pixel, poisoned

RECORDS = {kind: make() for kind, make in make_drive.RECORDS.items()}
KINDS = list(RECORDS)
PANELS = ["stage", "transport", "forces", "time", "run"]
SPACE = "\u00a0"


@pytest.fixture
def show(open_report):
    return functools.partial(open_report, "drive")


def written(value, decimals, unit=""):
    """A number as the page has to write it."""
    text = f"{value:.{decimals}f}"
    text = text[1:] if text.startswith("-") and float(text) == 0 else text.replace("-", "\u2212")
    return f"{text}{SPACE}{unit}" if unit else text


def seek(page, k):
    """The cursor on sample k."""
    page.run(f"page.seek(record.time[{k}])")
    page.settle()


def speed(record, k):
    return math.hypot(record["v_x_mps"][k], record["v_y_mps"][k])


def middle(record):
    return len(record["time_s"]) // 2


def tick_scale(marks):
    """Pixels of a value, by two tick marks [(pixel, text)] that the page has written: offset and pixels for each unit."""
    values = [(at, float(text.replace("\u2212", "-"))) for at, text in marks]
    (p, a), (q, b) = values[0], values[-1]
    for at, value in values:
        assert at == pytest.approx(p + (value - a) * (q - p) / (b - a), abs=0.1), "ticks stand evenly"
    return p - a * (q - p) / (b - a), (q - p) / (b - a)


class Plan:
    """Where W is on the screen, by the tick marks of the axes alone."""

    def __init__(self, page):
        page.run("window.scrollTo(0, 0)")
        page.settle()
        left, top = page.run("(b => [b.left, b.top])(by_id('plan').getBoundingClientRect())")
        marks = {axis: page.run(f"[...document.querySelectorAll('.plan-{axis}')].map(t => [Number(t.getAttribute('x')), Number(t.getAttribute('y')), t.textContent])") for axis in "xy"}
        self.x0, self.x = tick_scale([(m[0] + left, m[2]) for m in marks["x"]])
        self.y0, self.y = tick_scale([(m[1] - 4 + top, m[2]) for m in marks["y"]])  # a text's baseline is 4 px below its middle

    def __call__(self, x, y):
        return self.x0 + self.x * x, self.y0 + self.y * y


def in_W(record, k, ahead, left):
    h = math.radians(record["heading_deg"][k])
    return record["x_m"][k] + ahead * math.cos(h) - left * math.sin(h), record["y_m"][k] + ahead * math.sin(h) + left * math.cos(h)


# --- the test data -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_synthetic_records_have_all_keys_of_the_schema_and_no_other_and_say_what_they_are(kind):
    section = re.search(r"`saca\.drive/1`\)(.*?)\n## ", FORMATS.read_text(encoding="utf-8"), re.S).group(1)
    values = {"saca", "at rest", "lane recovered", "still moving"}
    documented = set(re.findall(r'"(\w+)"', section)) - values
    found = keys(RECORDS[kind])
    assert found == documented if kind == "draws" else found <= documented
    assert "SYNTHETIC TEST DATA" in RECORDS[kind]["command"]


@pytest.mark.parametrize("kind", KINDS)
def test_synthetic_records_agree_with_physics(kind):
    """What the maker computes in closed form agrees with differences of its own samples and with Newton's second law."""
    record = RECORDS[kind]
    for k in range(20, len(record["time_s"]) - 20, 7):
        h = math.radians(record["heading_deg"][k])
        for axis, cos, sin in (("x_m", math.cos(h), -math.sin(h)), ("y_m", math.sin(h), math.cos(h))):
            moved = (record[axis][k + 1] - record[axis][k - 1]) / 0.02
            assert moved == pytest.approx(record["v_x_mps"][k] * cos + record["v_y_mps"][k] * sin, abs=2e-3)  # O(dt^2) of a jerk
        push = [0.0, 0.0]
        for wheel in record["wheels"]:
            a = math.radians(wheel["angle_deg"][k])
            push[0] += wheel["F_x_N"][k] * math.cos(a) - wheel["F_y_N"][k] * math.sin(a)
            push[1] += wheel["F_x_N"][k] * math.sin(a) + wheel["F_y_N"][k] * math.cos(a)
        for force, a in zip(push, (record["a_x_mps2"][k], record["a_y_mps2"][k])):
            assert force == pytest.approx(record["car"]["mass_kg"] * a, abs=1.0)  # six decimals of m/s2 and degrees
        assert sum(w["load_N"][k] for w in record["wheels"]) == pytest.approx(record["car"]["mass_kg"] * make_drive.GRAVITY, abs=0.01)


# --- loading -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_loads_without_errors_and_asks_for_nothing(show, kind):
    page = show(RECORDS[kind])
    assert page.problems == []
    assert [url.split("/")[-1] for url in page.requests] == ["report.html"]
    text = page.run("document.body.innerText")
    assert RECORDS[kind]["command"] in text and RECORDS[kind]["program"] in text
    for slip in ("undefined", "NaN", "[object", "null", "Infinity"):
        assert slip not in text
    for panel in PANELS:
        assert page.run(f"by_id('{panel}').getBoundingClientRect().height") > 40, panel
    assert page.run("by_id('draws').hidden") == (RECORDS[kind]["draws"] is None)


@pytest.mark.parametrize("key", sorted(set(RECORDS["draws"]) - {"schema"}))
def test_a_record_may_lack_any_part(show, key):
    for value in ("missing", None):
        record = copy.deepcopy(RECORDS["draws"])
        del record[key]
        if value is None:
            record[key] = None
        page = show(record)
        page.run("page.seek(1)")
        assert page.problems == [], f"{key} {value}"
        assert "NaN" not in page.run("document.body.innerText")


def test_numbers_may_be_null(show):
    def without_numbers(value):
        if isinstance(value, dict):
            return {k: v if k == "time_s" and isinstance(v, list) else without_numbers(v) for k, v in value.items()}
        if isinstance(value, list):
            return [without_numbers(v) for v in value]
        return None if isinstance(value, (int, float)) else value

    page = show(without_numbers(RECORDS["draws"]))
    page.run("page.seek(1)")
    assert page.problems == []
    assert "NaN" not in page.run("document.documentElement.outerHTML.split('<script')[0]")


def test_text_of_a_record_never_becomes_markup(show):
    page = show(poisoned(RECORDS["draws"], spared=("schema",)))
    assert page.problems == []
    assert HOSTILE in page.run("by_id('title').textContent") and HOSTILE in page.run("by_id('run').textContent")
    assert HOSTILE in page.run("by_id('sentence').textContent") and HOSTILE in page.run("by_id('forces').textContent")
    assert page.run("document.querySelectorAll('img').length") == 0
    assert page.run("document.querySelectorAll('script').length") == 2
    assert page.run("window.hit === undefined")
    assert page.run("document.documentElement.scrollWidth") <= 1280


# --- header --------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_the_header_says_what_was_driven_and_how_it_ended(show, kind):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    title, sentence = page.run("by_id('title').textContent"), page.run("by_id('sentence').textContent")
    assert title.startswith(f"{record['policy']['name']} – ")
    words = {"T-D-R": "drift to a stop, turned right", "AEB": "full braking in the lane", "NI": "no intervention",
             "ES-B-L": f"lane change left while braking to 10.0{SPACE}m/s"}
    assert words[record["policy"]["name"]] in title
    for part in (record["car"]["name"], f"1700{SPACE}kg", written(record["start"]["speed_mps"], 1, "m/s"), f"grip {record['road']['grip']:.2f}", record["end"]["state"]):
        assert part in sentence
    assert ("bend to the left, radius 83" in sentence) == (kind == "bend")
    for key, text in (("time_s", written(record["end"]["time_s"], 2, "s")), ("forward_m", written(record["end"]["forward_m"], 2, "m")),
                      ("sideways_m", written(record["end"]["sideways_m"], 2, "m")), ("heading_deg", written(record["end"]["heading_deg"], 1) + "°")):
        assert page.run(f"document.querySelector('#end-{key} .tile-value').textContent") == text


# --- plan view -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind, share", [("slide", 0.3), ("slide", 1.0), ("draws", 0.6), ("braking", 0.5), ("bend", 0.8), ("instant", 0.0)])
def test_the_outline_is_where_the_record_says_as_large_as_it_is(show, kind, share):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    k = round(share * (len(record["time_s"]) - 1))
    seek(page, k)
    plan, blue, car = Plan(page), colour(page, "ego"), record["car"]
    assert plan.x == pytest.approx(-plan.y, rel=1e-3), "one scale for x and y"
    margin = 3.0 / plan.x  # the outline and a pixel [m]
    assert margin < 0.15
    front, rear, half = car["front_end_m"], car["front_end_m"] - car["length_m"], car["width_m"] / 2
    for ahead in (front - margin, rear + margin):
        for left in (0.8 * half, -0.8 * half):
            seen = pixel(page, *plan(*in_W(record, k, ahead, left)))
            assert like(seen, blue), f"{ahead:.2f} m ahead, {left:.2f} m left: {seen}"
    for left in (half - margin, margin - half):
        assert like(pixel(page, *plan(*in_W(record, k, 0.0, left))), blue)
    for ahead, left in ((front + margin, 0.8 * half), (front + margin, -0.8 * half), (rear - margin, 0.8 * half), (rear - margin, -0.8 * half), (0.0, half + margin), (0.0, -half - margin)):
        seen = pixel(page, *plan(*in_W(record, k, ahead, left)))
        assert not like(seen, blue, 40), f"{ahead:.2f} m ahead, {left:.2f} m left: {seen}"


def test_wheels_stand_at_their_angles_and_a_locked_one_is_marked(show):
    page, record = show(RECORDS["slide"]), RECORDS["slide"]
    k = max(range(len(record["time_s"])), key=lambda k: abs(record["wheels"][0]["angle_deg"][k]))
    seek(page, k)
    plan = Plan(page)
    for wheel in record["wheels"]:
        paint = colour(page, "wheel" if wheel["speed_mps"][k] > 0.1 else "threat")
        angle = math.radians(wheel["angle_deg"][k])
        for along in (-0.27, 0.0, 0.27):
            at = in_W(record, k, wheel["x_m"] + along * math.cos(angle), wheel["y_m"] + along * math.sin(angle))
            assert like(pixel(page, *plan(*at)), paint), f"{wheel['name']}, {along} m along"
        if abs(wheel["angle_deg"][k]) > 20:  # 0.3 m ahead its plane has left the body's by 0.12 m, more than half its width
            for along in (-0.3, 0.3):
                assert not like(pixel(page, *plan(*in_W(record, k, wheel["x_m"] + along, wheel["y_m"] - math.copysign(0.06, along * angle)))), paint)
    assert page.run("document.querySelectorAll('#car .wheel.locked').length") == 2
    seek(page, 5)
    assert page.run("document.querySelectorAll('#car .wheel.locked').length") == 0, "before the brakes bite"
    seek(page, len(record["time_s"]) - 1)
    assert page.run("document.querySelectorAll('#car .wheel.locked').length") == 0, "at rest no wheel is locked"


def test_the_lane_is_as_wide_as_it_is_and_bends_as_it_does(show):
    page, record = show(RECORDS["bend"]), RECORDS["bend"]
    plan, half, radius = Plan(page), record["road"]["lane_width_m"] / 2, 1 / record["road"]["curvature_1pm"]
    for s in (7.0, 24.0):  # between cars, on the inner and outer mark
        for d in (half, -half):
            x, y = (radius - d) * math.sin(s / radius), radius - (radius - d) * math.cos(s / radius)
            assert like(pixel(page, *plan(x, y)), colour(page, "mark")), f"s = {s}, d = {d}"


def test_ghosts_stand_every_quarter_of_a_second_and_at_the_end(show):
    page, record = show(RECORDS["bend"]), RECORDS["bend"]
    poses = page.run("[...document.querySelectorAll('.ghosts .car')].map(g => g.getAttribute('transform'))")
    samples = [*range(0, 249, 25), 249]
    want = [[record["x_m"][k], record["y_m"][k], record["heading_deg"][k]] for k in samples]
    assert [[float(n) for n in re.findall(r"-?[\d.]+", pose)] for pose in poses] == [pytest.approx(w, abs=1e-6) for w in want]


# --- forces --------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_forces_are_those_of_the_record_inside_their_circles_on_one_scale(show, kind):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    for k in sorted({0, len(record["time_s"]) // 4, middle(record), len(record["time_s"]) - 1}):
        seek(page, k)
        figures = page.run("""[...document.querySelectorAll('.circle')].map(f => { const at = (c) => { const b = f.querySelector(c).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2, b.width]; };
            return { peak: at('.peak'), tip: at('.tip'), text: f.querySelector('.values').innerText, name: f.querySelector('b').textContent, locked: !!f.querySelector('.tag') }; })""")
        scales = []
        for figure, wheel in zip(figures, record["wheels"]):
            (x, y, width), (tip_x, tip_y, _) = figure["peak"], figure["tip"]
            assert math.hypot(tip_x - x, tip_y - y) <= width / 2 + 1, "a force within its circle"
            scale = width / 2 / wheel["peak_N"][k]
            assert (tip_x - x, tip_y - y) == pytest.approx((-wheel["F_y_N"][k] * scale, -wheel["F_x_N"][k] * scale), abs=1.0), "forward is up, left is left"
            scales.append(scale)
            assert figure["name"] == wheel["name"]
            for text in (written(wheel["load_N"][k] / 1000, 2, "kN"), written(wheel["slip"][k], 2), written(wheel["F_x_N"][k] / 1000, 2, "kN"), written(wheel["F_y_N"][k] / 1000, 2, "kN")):
                assert text in figure["text"]
            assert figure["locked"] == (abs(wheel["speed_mps"][k]) < 0.1 and speed(record, k) > 0.5)
        assert scales == [pytest.approx(scales[0], rel=0.02)] * 4  # strokes and half pixels of a circle of some 80 px


def test_circles_stand_as_the_wheels_on_the_car(show):
    page = show(RECORDS["slide"])
    (fl, fr, rl, rr) = page.run("[...document.querySelectorAll('.circle')].map(f => (b => [b.x, b.y])(f.getBoundingClientRect()))")
    assert fl[0] == rl[0] < fr[0] == rr[0] and fl[1] == fr[1] < rl[1] == rr[1]


def test_the_trail_is_the_last_three_tenths_of_a_second(show):
    page, record = show(RECORDS["slide"]), RECORDS["slide"]
    for k, count in ((100, 31), (10, 11)):
        seek(page, k)
        points = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", page.run("document.querySelector('.circle .trace').getAttribute('d')"))
        wheel = record["wheels"][0]
        assert [tuple(map(float, p)) for p in points] == [pytest.approx((-wheel["F_y_N"][j], -wheel["F_x_N"][j])) for j in range(k, k - count, -1)]


# --- charts and cursor ---------------------------------------------------------------------------


def quantities(record, k):
    """What each chart has to say at sample k: (value or None, decimals, unit)."""
    v = speed(record, k)
    slip = math.degrees(math.atan2(record["v_y_mps"][k], record["v_x_mps"][k])) if v > 0.5 else None
    wheels = record["wheels"]
    return [[(v, 2, ""), (record["v_x_mps"][k], 2, ""), (record["v_y_mps"][k], 2, "")],
            [(record["yaw_rate_degps"][k], 1, "°/s"), (record["heading_deg"][k], 1, "°")], [(slip, 1, "")],
            [(record["a_x_mps2"][k], 2, ""), (record["a_y_mps2"][k], 2, "")],
            [(record["steering_deg"][k], 1, ""), (record["steering_command_deg"][k], 1, "")],
            [(w["brake_Nm"][k], 0, "") for w in wheels], [(record["motor_Nm"][k], 0, ""), (record["motor_command_Nm"][k], 0, "")],
            [(v, 2, ""), *((w["speed_mps"][k], 2, "") for w in wheels)]]


@pytest.mark.parametrize("kind", KINDS)
def test_the_cursor_moves_all_panels_and_the_values_are_those_of_the_record(show, kind):
    page, record = show(RECORDS[kind]), RECORDS[kind]
    for k in sorted({0, middle(record), len(record["time_s"]) - 1}):
        seek(page, k)
        t = record["time_s"][k]
        now = page.run("by_id('now').innerText.replaceAll('\\n', ' ')")
        for text in (written(t, 2, "s"), written(record["x_m"][k], 2, "m"), written(record["y_m"][k], 2, "m"), written(record["heading_deg"][k], 1) + "°"):
            assert text in now
        pose = [float(n) for n in re.findall(r"-?[\d.]+", page.run("by_id('car').getAttribute('transform')"))]
        assert pose == pytest.approx([record["x_m"][k], record["y_m"][k], record["heading_deg"][k]])
        assert page.run("Number(by_id('scrub').value)") == k
        rows = page.run("""[...document.querySelectorAll('.chart-row:not(.chart-axis)')].map(r => ({ cells: [...r.querySelectorAll('dd')].map(d => d.textContent),
            ticks: [...r.querySelectorAll('.chart-track text')].map(t => [Number(t.getAttribute('y')) - 3.5, t.textContent]), left: r.querySelector('.chart-track').getBoundingClientRect().left,
            dots: [...r.querySelectorAll('.dot')].map(d => d.getAttribute('visibility') === 'hidden' ? null : [Number(d.getAttribute('cx')), Number(d.getAttribute('cy'))]) }))""")
        marks = page.run("[...document.querySelectorAll('.chart-axis text.tick:not(.axis-name)')].map(t => [Number(t.getAttribute('x')), t.textContent])")
        x0, x_unit = tick_scale(marks)
        cursor = page.run("(b => b.left + b.width / 2)(document.querySelector('.chart-cursor').getBoundingClientRect())")
        for row, truths in zip(rows, quantities(record, k), strict=True):
            assert row["cells"] == [("–" if v is None else written(v, d) + unit) for v, d, unit in truths]
            y0, y_unit = tick_scale(row["ticks"])
            for dot, (v, _, _) in zip(row["dots"], truths, strict=True):
                assert dot == (None if v is None else pytest.approx([x0 + x_unit * t, y0 + y_unit * v], abs=0.15))
            assert cursor == pytest.approx(row["left"] + x0 + x_unit * t, abs=1.0), "one axis, one cursor"
    assert page.problems == []


def test_curves_hold_every_sample_and_commands_are_thinner(show):
    page, record = show(RECORDS["slide"]), RECORDS["slide"]
    curves = page.run("[...document.querySelectorAll('.chart-track .curve')].map(c => [c.getAttribute('d').split(/[ML]/).length - 1, c.classList.contains('thin'), parseFloat(getComputedStyle(c).strokeWidth)])")
    still = sum(speed(record, k) <= 0.5 for k in range(len(record["time_s"])))
    assert sorted(n for n, *_ in curves) == sorted([len(record["time_s"])] * 24 + [len(record["time_s"]) - still])
    seek(page, 70)
    pairs = page.run("""[...document.querySelectorAll('.chart-track')].flatMap(t => { const curves = [...t.querySelectorAll('.curve')].slice(-t.querySelectorAll('.dot').length);
        return curves.map((c, i) => [c.getAttribute('d').split(/[ML]/)[71], t.querySelectorAll('.dot')[i].getAttribute('cx'), t.querySelectorAll('.dot')[i].getAttribute('cy')]); })""")
    for point, *dot in (p for p in pairs if p[0]):
        assert [float(n) for n in point.split()] == pytest.approx([float(n) for n in dot], abs=0.01), "a dot rides on its curve"
    assert len(pairs) == 21 and all(p[0] for p in pairs)
    assert sum(thin for _, thin, _ in curves) == 6, "steering, motor and four brakes"
    assert max(width for _, thin, width in curves if thin) < min(width for _, thin, width in curves if not thin)


def test_a_heading_that_goes_round_does_not_cross_the_chart(show):
    record = copy.deepcopy(RECORDS["slide"])
    record["heading_deg"] = [make_drive.wrapped(2 * h) for h in record["heading_deg"]]
    assert min(record["heading_deg"]) < -170 and max(record["heading_deg"]) > 170
    d = show(record).run("document.querySelectorAll('.chart-row')[1].querySelectorAll('.chart-track .curve')[1].getAttribute('d')")
    assert d.count("M") == 2


def test_mouse_and_touch_move_the_cursor(show):
    page, record = show(RECORDS["slide"]), RECORDS["slide"]
    page.run("by_id('charts').scrollIntoView({block: 'center'})")
    page.settle()
    box = page.run("(b => [b.left, b.top, b.height])(document.querySelector('.chart-row .chart-track').getBoundingClientRect())")
    x0, x_unit = tick_scale(page.run("[...document.querySelectorAll('.chart-axis text.tick:not(.axis-name)')].map(t => [Number(t.getAttribute('x')), t.textContent])"))
    at = lambda t: {"x": box[0] + x0 + x_unit * t, "y": box[1] + box[2] / 2}
    page.call("Input.dispatchMouseEvent", type="mousePressed", button="left", clickCount=1, **at(0.4))
    assert page.run("page.t") == pytest.approx(0.4, abs=0.005)
    page.call("Input.dispatchMouseEvent", type="mouseMoved", button="left", buttons=1, **at(1.6))
    assert page.run("page.t") == pytest.approx(1.6, abs=0.005)
    page.call("Input.dispatchMouseEvent", type="mouseReleased", button="left", clickCount=1, **at(1.6))
    page.call("Input.dispatchMouseEvent", type="mouseMoved", **at(0.2))
    assert page.run("page.t") == pytest.approx(1.6, abs=0.005), "let go"
    page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[at(1.0)])
    page.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[at(0.8)])
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    assert page.run("page.t") == pytest.approx(0.8, abs=0.005)
    page.run("by_id('scrub').value = '30'; by_id('scrub').dispatchEvent(new Event('input'))")
    assert page.run("page.t") == pytest.approx(record["time_s"][30])
    plan, k = Plan(page), 60
    x, y = plan(record["x_m"][k], record["y_m"][k])
    page.call("Input.dispatchMouseEvent", type="mousePressed", button="left", clickCount=1, x=x, y=y)
    page.call("Input.dispatchMouseEvent", type="mouseReleased", button="left", clickCount=1, x=x, y=y)
    assert page.run("page.t") == pytest.approx(record["time_s"][k], abs=0.015), "a press on the path: to when the car was there"


def test_keys_and_play(show):
    page, record = show(RECORDS["slide"]), RECORDS["slide"]
    page.run("page.seek(1)")
    page.key("ArrowRight")
    assert page.run("page.t") == pytest.approx(1.01)
    page.key("ArrowLeft")
    page.key("ArrowLeft")
    assert page.run("page.t") == pytest.approx(0.99)
    page.key("End")
    assert page.run("page.t") == pytest.approx(record["time_s"][-1])
    page.key("Home")
    assert page.run("page.t") == 0
    for rate in ("0.1", "0.25", "0.5", "1"):
        assert page.run(f"by_id('rate').value = '{rate}'; page.t = 1; page.playing = true; page.step(1200, 1000); page.play(false); page.t") == pytest.approx(1 + 0.2 * float(rate))
    assert page.run("by_id('rate').value = '1'; page.seek(page.end - 0.05); by_id('play').click(); by_id('play').textContent") == "Pause"
    page.run("new Promise(done => { const look = () => page.playing ? requestAnimationFrame(look) : done(1); look(); })")
    assert page.run("page.t") == pytest.approx(record["time_s"][-1]) and page.run("by_id('play').textContent") == "Play"
    assert page.problems == []


def test_one_sample_is_shown_and_nothing_can_be_played(show):
    page, record = show(RECORDS["instant"]), RECORDS["instant"]
    assert len(record["time_s"]) == 1
    assert page.run("['play', 'back', 'forth', 'scrub', 'rate'].every(id => by_id(id).disabled)")
    page.run("page.play(true); page.seek(5)")
    assert page.run("page.t") == 0 and not page.run("page.playing")
    assert page.run("[...document.querySelectorAll('.dot')].every(d => d.getAttribute('visibility') === 'visible')")
    assert page.problems == []


# --- draws ---------------------------------------------------------------------------------------


def test_draws_are_drawn_and_counted(show):
    page, record = show(RECORDS["draws"]), RECORDS["draws"]
    draws = record["draws"]
    assert page.run("document.querySelectorAll('.draw-path').length") == 50
    assert page.run("document.querySelector('.draw-heading').getAttribute('d').split('M').length - 1") == 400
    within = draws["within_10_deg"]
    text = page.run("by_id('within').innerText")
    for share in (within["share"], within["low"], within["high"]):
        assert f"{100 * share:.1f}{SPACE}%" in text
    rows = page.run("[...document.querySelectorAll('#draws tbody tr')].map(r => [...r.cells].map(c => c.textContent))")
    for row, (key, decimals, unit) in zip(rows, (("time_s", 2, "s"), ("forward_m", 2, "m"), ("sideways_m", 2, "m"), ("heading_deg", 1, "°")), strict=True):
        truths = [record["end"][key], *(draws[key][p] for p in ("p05", "p50", "p95"))]
        assert row[1:] == [written(v, decimals) + unit if unit == "°" else written(v, decimals, unit) for v in truths]
    unknown = page.run("document.querySelector('#draws .facts').innerText")
    for text in (f"6{SPACE}%", f"3{SPACE}%", f"4{SPACE}%", f"10{SPACE}%", f"10{SPACE}ms", f"0.15{SPACE}m/s"):
        assert text in unknown
    counted = page.run("[...document.querySelectorAll('.histogram .bin')].map(b => Number(b.getAttribute('height')))")
    whole = page.run("Number(document.querySelector('.histogram text:last-of-type').textContent)")
    assert round(sum(counted) / max(counted) * whole) == 400, "every end is in one bin"


def test_other_policies_have_no_share_within_ten_degrees(show):
    record = copy.deepcopy(RECORDS["draws"])
    record["draws"]["within_10_deg"] = None
    page = show(record)
    assert page.problems == [] and not page.run("by_id('draws').hidden")
    assert page.run("by_id('within') === null && document.querySelector('.histogram .band') === null")


# --- appearance ----------------------------------------------------------------------------------


def test_dark_and_light_by_button_both_with_visible_curves_and_readable_text(show):
    page, seen = show(RECORDS["draws"]), {}
    for _ in range(2):
        dark = page.run("is_dark()")
        seen[dark] = pixel(page, 4, 4)
        names = [f"wheel-{i}" for i in range(4)] + ["curve-a", "curve-b", "curve-c", "forecast"]
        for name in names:  # graphics: WCAG 2.1, 1.4.11
            assert contrast(colour(page, name), colour(page, "panel")) >= 3, f"{name}, {'dark' if dark else 'light'}"
        for ink, paper in (("ink", "panel"), ("soft", "panel"), ("ink", "paved"), ("bad", "bad-bg")):
            assert contrast(colour(page, ink), colour(page, paper)) >= 4.5, f"{ink} on {paper}, {'dark' if dark else 'light'}"
        page.run("by_id('theme').click()")
        page.settle()
    assert luminance(seen[True]) < 0.05 < 0.7 < luminance(seen[False])
    assert page.problems == []


def test_right_wheels_differ_from_left_ones_by_more_than_colour(show):
    dashes = show(RECORDS["slide"]).run("[...[...document.querySelectorAll('.chart-row')][7].querySelectorAll('.chart-track .curve')].map(c => getComputedStyle(c).strokeDasharray)")
    assert [d == "none" for d in dashes] == [True, True, False, True, False]


@pytest.mark.parametrize("kind", KINDS)
def test_fits_a_telephone(show, kind):
    page = show(RECORDS[kind], 400, 800)
    assert page.problems == []
    assert page.run("document.documentElement.scrollWidth") <= 400
    assert page.run("plan.upright"), "forward is up where there is little width"
    forward = page.run("[...document.querySelectorAll('.plan-x')].map(t => Number(t.getAttribute('y')))")
    assert forward == sorted(forward, reverse=True)
    assert page.run("[...document.querySelectorAll('.circle figcaption b')].every(b => b.scrollWidth <= b.clientWidth)"), "no name is cut"


def test_printing_is_light_without_buttons_and_leaves_no_trace(show):
    page = show(RECORDS["draws"])
    page.run("by_id('theme').click()")
    state = "[is_dark(), plan.width, charts.width]"
    before = page.run(state)
    page.call("Emulation.setEmulatedMedia", media="print")
    try:
        page.run("window.dispatchEvent(new Event('beforeprint'))")
        assert not page.run("is_dark()")
        assert page.run("[...document.querySelectorAll('button, select, input')].filter(b => b.offsetHeight).length") == 0
        page.run("window.dispatchEvent(new Event('afterprint'))")
    finally:
        page.call("Emulation.setEmulatedMedia", media="")
    page.settle()
    assert page.run(state) == before and before[0]


def test_whatever_can_be_pressed_or_seen_has_a_name(show):
    page = show(RECORDS["draws"])
    assert page.run("[...document.querySelectorAll('button, select, input')].filter(b => !(b.textContent.trim() || b.getAttribute('aria-label') || b.closest('label'))).length") == 0
    assert page.run("[...document.querySelectorAll('svg')].filter(s => !s.parentElement.closest('svg') && !s.getAttribute('aria-label') && s.getAttribute('aria-hidden') !== 'true').length") == 0
    assert page.run("[...document.querySelectorAll('h1')].length") == 1
    assert "15.62 metres forward" in page.run("by_id('plan').getAttribute('aria-label')")
    seek(page, 100)
    assert page.run("by_id('scrub').getAttribute('aria-valuetext')") == "1.00 seconds"


if __name__ == "__main__":
    sys.exit(pytest.main([__file__, "-q"]))
