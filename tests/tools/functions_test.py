"""Functions of sources have at most 50 lines; those that still have more are named here and do not grow.

A function stands at the margin, as clang-format leaves it: it begins with a line that has a parenthesis and ends with the next line that is a
brace alone. What stands within classes is not counted.
"""

import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST = 50
LONGER = {
    "apps/model_host/engine.cpp": 54,
    "apps/train/places.cpp": 51,
    "saca/lab/encounter/review.cpp": 53,
    "saca/lab/eval/oracle.cpp": 55,
    "saca/lab/eval/particle_filter.cpp": 51,
    "saca/lab/eval/place_examples.cpp": 52,
    "saca/lab/eval/suite_figures.cpp": 85,
    "saca/lab/learned_danger/net_inputs.cpp": 73,
    "saca/lab/prepare/atlas_build.cpp": 54,
    "saca/lab/recordings/hundred_car_file.cpp": 52,
    "saca/lab/report/value_json.cpp": 60,
    "saca/lab/suites/shadow.cpp": 73,
    "saca/onboard/collision/edge.cpp": 58,
    "saca/onboard/forecast/atlas_ego.cpp": 51,
    "saca/onboard/forecast/broad_phase.cpp": 57,
    "saca/onboard/forecast/edge_sweep.cpp": 51,
    "saca/onboard/forecast/likeliest.cpp": 61,
    "saca/thinking/arbitration/thinking_plane.cpp": 92,
    "saca/thinking/language_model/replay_model.cpp": 59,
    "saca/thinking/language_model/scripted_model.cpp": 53,
}
NO_FUNCTION = (" ", "}", "#", "/", "namespace", "using", "struct", "class", "enum", "constexpr", "template")


def longest_function(text):
    longest, begin = 0, None
    for number, line in enumerate(text.split("\n")):
        if begin is None and line and not line.startswith(NO_FUNCTION) and "(" in line:
            begin, opened = number, False
        if begin is None:
            continue
        opened = opened or line.endswith("{")
        if line == "}":
            longest, begin = max(longest, number - begin + 1), None
        elif line.endswith(";") and not opened:
            begin = None  # a declaration, or a constant
    return longest


def test_lines_are_counted_from_the_first_to_the_last_brace():
    assert longest_function("int one() {\n  return 1;\n}\n") == 3
    assert longest_function("void declared(int a);\n\nint two(int a,\n        int b) {\n  return a;\n}\n") == 4
    assert longest_function("struct S {\n  int a = f();\n};\n") == 0


def test_no_function_has_more_lines_but_those_that_are_named():
    listed = subprocess.run(["git", "ls-files", "saca/*.cpp", "apps/*.cpp"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    found = {}
    for name in listed:
        if not name.endswith(("_test.cpp", "_bench.cpp")):
            lines = longest_function((ROOT / name).read_text())
            if lines > MOST:
                found[name] = lines
    assert found == LONGER  # one that has become shorter is taken off the list
