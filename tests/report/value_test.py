"""The page of a solved value: what was solved as seen from the ego is shown in the obstacle's frame."""

import base64
import functools
import itertools
import math
import re

import pytest

LOWEST, HIGHEST = -40.0, 5.0
PI = math.pi


def axis(name, unit, first, last, points, edge="open", turned=None):
    coordinates = [first + k * (last - first) / (points if edge == "periodic" else points - 1) for k in range(points)]
    return {"name": name, "unit": unit, "factor": 180 / PI if unit == "deg" else 1.0, "edge": edge, "last": last, "points": points,
            "turned": turned, "coordinates": coordinates}


def byte(value):
    share = value / (HIGHEST if value >= 0 else LOWEST)
    root = round(127 * math.sqrt(min(1.0, share)))
    return 128 + root if value >= 0 else 128 - max(1, root)


def record(from_ego, value, course=0.0):
    """Of a function of x, y and course; the same box of states about the obstacle at course 0."""
    speed = axis("speed", "m/s", 0.0, 20.0, 2)
    around = axis("course", "deg", -PI, PI, 24, "periodic")
    x, y = axis("x", "m", -20.0, 8.0, 57), axis("y", "m", 0.0, 10.0, 21, "mirrored", 2)
    axes, shown = [x, y, around, speed], None
    if from_ego:
        axes = [axis("ahead", "m", -8.0, 20.0, 57), {**y, "name": "left"}, {**around, "name": "turned"}, speed]
        shown = [axis("x", "m", -20.0, 8.0, 2), axis("y", "m", -10.0, 10.0, 2), around, speed]

    def kept(v, angle, across, along):
        if from_ego:
            c, s = math.cos(angle), math.sin(angle)
            return value(-c * along - s * across, s * along - c * across, -angle)
        return value(along, across, angle)

    places = itertools.product(*(a["coordinates"] for a in reversed(axes)))
    values = bytes(byte(kept(*place)) for place in places)
    colours = [[k * 40, k * 40, k * 40] for k in range(6)]
    return {"schema": "saca.value_page/1", "title": "cone", "problem": "", "complete": True, "times_s": [1.0],
            "start": {"time": 0, "others": [0, 0, course, 10.0], "zoom": 1.0}, "axes": axes, "shown": shown, "value_words": "V [m]",
            "value_unit": "m", "extent": {"lowest": LOWEST, "highest": HIGHEST}, "scale": {"lowest": LOWEST, "highest": HIGHEST},
            "rounding": 0.3, "colours": {"danger": colours, "safety": colours}, "outline": [[-2, -1], [2, -1], [2, 1], [-2, 1]],
            "values": base64.b64encode(values).decode()}


def cone(x, y, _):
    return 4.5 - math.hypot(x, y)


def leaning(x, y, course):
    """Tells left from right, and one direction of the course from the other."""
    return -10.0 + 0.3 * x - 0.5 * y * math.sin(course)


@pytest.fixture
def show(open_report):
    return functools.partial(open_report, "value")


def raster(page, course, columns=28, rows=20):
    """Over x from -20 to 8 m and y from -10 to 10 m: rows from the highest y, None where nothing is kept."""
    flat = page.run(f"Array.from(table_of_values.raster(0, [0, 0, {course}, 10], [[-20, 8], [-10, 10]], {columns}, {rows}), v => Number.isNaN(v) ? null : v)")
    return [flat[r * columns:(r + 1) * columns] for r in range(rows)]


def test_both_views_show_the_same_plane(show):
    rasters = [raster(show(record(from_ego, cone)), 0.4) for from_ego in (False, True)]
    compared = 0
    for one, other in zip(*(itertools.chain(*r) for r in rasters)):
        if other is not None:
            steps = 2 * math.sqrt(LOWEST * min(-1, one)) / 127  # half a step of the byte in each, and the grids' spacing
            assert one == pytest.approx(other, abs=steps + 0.05)
            compared += 1
    assert compared > 400


@pytest.mark.parametrize("course", [0.0, PI / 4, -PI / 2, 3 * PI / 4, -PI])
def test_left_and_right_are_told_apart_and_what_is_not_kept_is_blank(show, course):
    blank = 0
    for r, row in enumerate(raster(show(record(True, leaning)), course)):
        for c, value in enumerate(row):
            x, y = -19.5 + c, 9.5 - r
            ahead, left = -(math.cos(course) * x + math.sin(course) * y), math.sin(course) * x - math.cos(course) * y
            inside = -8 <= ahead <= 20 and abs(left) <= 10
            assert (value is not None) == inside, (x, y)
            blank += not inside
            if inside:
                assert value == pytest.approx(leaning(x, y, course), abs=0.35), (x, y)
    assert (blank == 0) == (course == 0.0)


def test_the_plane_spans_what_is_kept_at_the_course(show):
    page = show(record(True, cone))
    half = math.sqrt(0.5)
    for course, wanted in [(0, [[-20, 8], [-10, 10]]), (PI / 2, [[-10, 10], [-20, 8]]), (PI / 4, [[-30 * half, 18 * half]] * 2)]:
        found = page.run(f"table_of_values.whole([0, 0, {course}, 10])")
        assert [end for ends in found for end in ends] == pytest.approx([end for ends in wanted for end in ends])


def test_sliders_and_words_are_of_the_obstacles_frame(show):
    page = show(record(True, cone))
    names = page.run("[...document.querySelectorAll('.slider span')].map(s => s.textContent)")
    assert names == ["course", "speed", "zoom"]
    assert page.run("by_id('sentence').textContent").replace("\u00a0", " ").startswith("V over x and y at course 0.0 deg, speed 10.0 m/s")
    page.run("(() => { const course = document.querySelector('.slider input'); course.value = Math.PI / 2; course.dispatchEvent(new Event('input')); })()")
    page.settle()
    sentence = page.run("by_id('sentence').textContent").replace("\u00a0", " ")
    share = float(re.search(r"([\d.]+) % of what is shown", sentence)[1])
    assert "course 90" in sentence
    assert share == pytest.approx(100 * PI * 4.5**2 / (28 * 20), abs=0.5)
    assert not page.problems and not [url for url in page.requests if not url.startswith("file:")]
