"""The four floors: docs/architecture.md lists the modules that CMake builds, in its order, and no floor includes a higher one."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLOORS = ["base", "onboard", "thinking", "runtime", "lab"]
# Built where libtorch is found; the page tells of it below its table.
APART = {"lab/network_training"}


def modules_of_cmake():
    text = (ROOT / "CMakeLists.txt").read_text()
    lists = {floor: re.search(rf"^set\(saca_{floor} ([^)]*)\)", text, re.MULTILINE) for floor in FLOORS if floor != "runtime"}
    return [module for floor in FLOORS
            for module in (["runtime"] if floor == "runtime" else [f"{floor}/{name}" for name in lists[floor].group(1).split()])]


def modules_of_page():
    table = (ROOT / "docs/architecture.md").read_text().split("| module | holds |\n|---|---|\n")[1].split("\n\n")[0]
    return [re.match(r"\| `([a-z_/]+)` \| \S", line).group(1) for line in table.splitlines()]


def test_the_page_lists_what_cmake_builds():
    assert modules_of_page() == modules_of_cmake()


def test_every_folder_is_a_module():
    folders = {str(file.parent.relative_to(ROOT / "saca")) for file in (ROOT / "saca").rglob("CMakeLists.txt")}
    assert folders == set(modules_of_cmake()) | APART


def test_no_floor_includes_a_higher_one():
    upward = []
    for source in sorted((ROOT / "saca").rglob("*.*")):
        if source.suffix not in (".h", ".cpp") or re.search(r"_(test|bench)\.cpp$|_for_test\.h$", source.name):
            continue
        own = FLOORS.index(source.relative_to(ROOT / "saca").parts[0])
        included = re.findall(r'^#include "(saca/([a-z]+)/[^"]*)"', source.read_text(), re.MULTILINE)
        upward += [f"{source.relative_to(ROOT)}: {path}" for path, floor in included if FLOORS.index(floor) > own]
    assert upward == []
