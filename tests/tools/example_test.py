"""What comments show is what examples compile."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]


def struct_brake(lines):
    """The struct of this name, without comments and blanks at ends."""
    text = "\n".join(lines)
    found = re.search(r"struct Brake \{.*?\n\};", text, re.DOTALL)
    assert found, text
    return [re.sub(r"\s*//.*", "", line).rstrip() for line in found[0].splitlines()]


def test_the_system_in_the_header_is_that_of_the_example():
    header = (ROOT / "saca/lab/levelset/flow.h").read_text().splitlines()
    shown = struct_brake(line.removeprefix("///     ") for line in header if line.startswith("///     "))
    compiled = struct_brake((ROOT / "examples/own_dynamics/main.cpp").read_text().splitlines())
    assert shown == compiled
    assert 10 < len(compiled) < 20  # a dozen lines
