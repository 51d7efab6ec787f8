#!/usr/bin/env python3
"""Runs the tests of a preset that have not passed yet with the very programs and files that are there now.

A test program is known by its bytes: it is linked statically from what is compiled, so a change that does not reach it
leaves it as it was. A test written in Python is known by its file, what that names of its folder, and the programs that it
starts. Data, scenarios, weights and records count for every test. What is mostly not read by tests (sources, scripts,
pages of documentation) counts for those whose program or script names it: by its path, or by a folder above it.
Whatever is neither program nor Python (checks of includes, sources that must not compile) always runs.

usage: tools/ctest_again.py PRESET [OPTION OF CTEST...]
    SACA_TEST_ALL=1 runs all of them.
"""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMPILED = (".cpp", ".h", ".cmake", "CMakeLists.txt")
SELDOM_READ = ("docs", "tools", "viewer", "training", "cmake", ".ci")  # folders


def digest_of(path, known={}):
    stat = path.stat()
    key = (path, stat.st_mtime_ns, stat.st_size)
    if key not in known:
        known[key] = hashlib.sha256(path.read_bytes()).hexdigest()
    return known[key]


def is_read_where_named(name):
    """Is a file of the clone read by no test but those that name it?"""
    folder, _, rest = name.partition("/")
    return not rest or folder in SELDOM_READ or name.endswith((".md", *COMPILED)) or (folder == "tests" and name.endswith(".py"))


def mentions(text, folder, root=None):
    """Paths that a text names: `docs/formats.md`; the folder's own name where it is a whole string. The end of another path is
    none, unless that begins with the root, if one is given, and else with what is put in there."""
    found, at = set(), text.find(folder)
    while at >= 0:
        path = re.compile(rb"[\w./-]*").match(text, at).group()
        before, after = text[at - 1:at] if at else b"\0", text[at + len(path):at + len(path) + 1] or b"\0"
        whole = before in (b"\0", b'"', b"'") and after in (b"\0", b'"', b"'")
        if before == b"/":
            begins = text[:at - 1].endswith(os.fsencode(root)) if root else text[at - 2:at - 1] in (b"}", b".", b'"', b"'")
        else:
            begins = not before.isalnum() and before not in (b"_", b"-", b".")
        if begins and (path.startswith(folder + b"/") or (path == folder and whole)):
            found.add(path.rstrip(b"./").decode())
        at = text.find(folder, at + len(folder))
    return found


class Clone:
    """The files that git knows or would add."""

    def __init__(self, root, names):
        self.root = root
        self.names = sorted(name for name in set(names) if name and (root / name).is_file())
        self._below, self._named_in = {}, {}
        for name in self.names:
            for depth in range(name.count("/")):
                self._below.setdefault("/".join(name.split("/")[:depth + 1]), []).append(name)
        self.always_read = self.digest(name for name in self.names if not is_read_where_named(name))

    def digest(self, names):
        total = hashlib.sha256()
        for name in sorted(names):
            total.update(f"{name} {digest_of(self.root / name)}\n".encode())
        return total.hexdigest()

    def named_in(self, path, is_program):
        """What is read where it is named, and is named in this file. Sources do not count for a program, which has names of
        its own sources in it."""
        key = (digest_of(path), is_program)
        if key not in self._named_in:
            text = path.read_bytes()
            if not is_program:
                text = re.sub(rb"""["']\s*/\s*["']""", b"/", text)  # ROOT / "docs" / "formats.md"
            found = set()
            for first in {name.partition("/")[0] for name in self.names}:
                for mention in mentions(text, first.encode(), self.root if is_program else None):
                    found.update(self._meant_by(mention))
            self._named_in[key] = {name for name in found
                                   if is_read_where_named(name) and not (is_program and name.endswith(COMPILED))}
        return self._named_in[key]

    def _meant_by(self, mention):
        while mention and mention not in self._below and not (self.root / mention).is_file():
            mention = mention.rpartition("/")[0]  # a pattern, or a name that is put together
        return self._below.get(mention, [mention] if mention else [])


def clone():
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.split("\0")
    return Clone(ROOT, names)


def python_files(start):
    """A test's file (or all of a folder), and those beside it that it names, to import or to start them."""
    known, waiting = set(), {*start.glob("*.py")} if start.is_dir() else {start, start.parent / "conftest.py"}
    while waiting:
        file = waiting.pop()
        if file in known or not file.is_file():
            continue
        known.add(file)
        waiting |= {file.parent / f"{word}.py" for word in set(re.findall(r"\w+", file.read_text()))}
    return known


def programs_in(build):
    """What tests start beside themselves: the command line, the model's process."""
    found = [build / "saca", *build.glob("apps/*/saca-*"), *build.glob("saca-*")]
    return {path for path in found if path.is_file()}


def files_among(words, build):
    paths = [pathlib.Path(word.split("=", 1)[-1]) for word in words]
    return [path for path in paths if path.is_absolute() and path.is_file() and build in path.parents]


def with_tools(scripts, clone):
    """A test's scripts, and the project's own tools that these name."""
    known, waiting = set(), set(scripts)
    while waiting:
        script = waiting.pop()
        known.add(script)
        tools = {clone.root / name for name in clone.named_in(script, is_program=False) if name.startswith("tools/")}
        waiting |= {tool for tool in tools - known if tool.suffix in (".py", ".sh")}
    return known


def with_what_they_start(programs, clone, build):
    """Programs, and those that they name. The command line is never started by another: its name is everywhere."""
    known, waiting = set(), set(programs)
    while waiting:
        program = waiting.pop()
        known.add(program)
        text = program.read_bytes()
        waiting |= {other for other in programs_in(build) - known if other.name != "saca" and other.name.encode() in text}
    weights = clone.root / "third_party" / "models" / "choice.json"  # which the model's process finds
    if any(path.name == "saca-model-host" for path in known) and weights.is_file():
        known.add(weights)
    return known


def key_of(test, build, clone):
    """None: it always runs."""
    command = test.get("command", [])
    environment = next((one["value"] for one in test.get("properties", []) if one["name"] == "ENVIRONMENT"), [])
    is_python = "pytest" in command
    if not is_python and not files_among(command[:1], build):
        return None
    parts = [" ".join(command), " ".join(environment), clone.always_read]
    named = set()
    if is_python:
        asked = [path for path in map(pathlib.Path, command[1:]) if path.is_absolute() and path.exists()]
        scripts = set().union(*map(python_files, asked))
        if not scripts:
            return None
        parts += [f"{path.name} {digest_of(path)}" for path in sorted(scripts)]
        for script in sorted(with_tools(scripts, clone)):
            named |= clone.named_in(script, is_program=False)
            made = {path for path in mentions(script.read_bytes(), b"build") if (clone.root / path).is_file()}
            parts.append("there is " + " ".join(sorted(made)))  # some are skipped where a tool has not been set up
    files = with_what_they_start(files_among(command, build) + files_among(environment, build), clone, build)
    for path in sorted(files):
        parts.append(digest_of(path))
        named |= clone.named_in(path, is_program=True)
    return hashlib.sha256("\n".join([*parts, clone.digest(named)]).encode()).hexdigest()


def all_tests(preset):
    shown = subprocess.run(["ctest", "--preset", preset, "--show-only=json-v1"], cwd=ROOT, check=True, capture_output=True, text=True)
    return json.loads(shown.stdout)["tests"]


def passed_in(junit):
    cases = xml.etree.ElementTree.parse(junit).getroot().iter("testcase")
    return {case.get("name") for case in cases if case.get("status") == "run" and case.find("failure") is None}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    preset, options = sys.argv[1], sys.argv[2:]
    build = ROOT / "build" / preset
    record = build / "passed.json"
    try:
        known = json.loads(record.read_text())
    except (OSError, ValueError):
        known = {}
    tests = all_tests(preset)
    files = clone()
    keys = {test["name"]: key_of(test, build, files) for test in tests}
    again = os.environ.get("SACA_TEST_ALL") == "1"
    numbers = [number for number, test in enumerate(tests, 1)
               if again or keys[test["name"]] is None or known.get(test["name"]) != keys[test["name"]]]
    if len(numbers) < len(tests):
        print(f"{len(tests) - len(numbers)} of {len(tests)} tests have passed with these programs and files: "
              "not run again (SACA_TEST_ALL=1 runs them)", flush=True)
    if not numbers:
        return
    junit = build / "passed.xml"
    junit.unlink(missing_ok=True)
    chosen = [] if len(numbers) == len(tests) else ["-I", "0,0,0," + ",".join(map(str, numbers))]
    result = subprocess.run(["ctest", "--preset", preset, "--output-junit", str(junit), *chosen, *options], cwd=ROOT)
    if junit.exists():
        passed = passed_in(junit)
        known.update({name: key for name, key in keys.items() if key is not None and name in passed})
        for name in keys.keys() & known.keys() - passed:
            if name in {tests[number - 1]["name"] for number in numbers}:
                del known[name]
        record.write_text(json.dumps(known, indent=1, sort_keys=True))
    sys.exit(result.returncode)


if __name__ == "__main__":
    main()
