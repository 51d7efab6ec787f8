#!/usr/bin/env python3
"""Runs the tests of a preset that have not passed yet with the very programs and files that are there now.

A test program is known by its bytes: it is linked statically from what is compiled, so a change that does not reach it
leaves it as it was. What it reads counts as well: every file of the clone but C++ sources, which are in the program, and,
for programs, pages of documentation. Tests written in Python depend on the programs that they start, too. Whatever is
neither (checks of includes, sources that must not compile) always runs.

usage: tools/ctest_again.py PRESET [OPTION OF CTEST...]
    SACA_TEST_ALL=1 runs all of them.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent


def digest_of(path, known={}):
    stat = path.stat()
    key = (path, stat.st_mtime_ns, stat.st_size)
    if key not in known:
        known[key] = hashlib.sha256(path.read_bytes()).hexdigest()
    return known[key]


def is_compiled(name):
    return name.startswith(("saca/", "apps/", "tests/")) and name.endswith((".cpp", ".h"))


def clone_digest(skipped):
    """Of all files that git knows or would add, but those whose names are to be skipped."""
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.split("\0")
    total = hashlib.sha256()
    for name in sorted(set(names)):
        path = ROOT / name
        if name and not skipped(name) and path.is_file():
            total.update(f"{name} {digest_of(path)}\n".encode())
    return total.hexdigest()


def programs_of(build):
    """What tests start beside themselves: the command line, the model's process, and the weights it finds."""
    found = [build / "saca", *build.glob("apps/*/saca-*"), *build.glob("saca-*"), ROOT / "third_party" / "models" / "choice.json"]
    return [path for path in found if path.is_file()]


def files_among(words, build):
    paths = [pathlib.Path(word.split("=", 1)[-1]) for word in words]
    return [path for path in paths if path.is_absolute() and path.is_file() and build in path.parents]


def key_of(test, build, trees):
    """None: it always runs."""
    command = test.get("command", [])
    properties = {one["name"]: one["value"] for one in test.get("properties", [])}
    environment = properties.get("ENVIRONMENT", [])
    if not command:
        return None
    own = files_among(command[:1], build)
    is_python = "pytest" in command
    if not own and not is_python:
        return None
    parts = [" ".join(command), " ".join(environment), trees["python" if is_python else "program"]]
    parts += [digest_of(path) for path in own + files_among(command[1:], build) + files_among(environment, build)]
    named = files_among(environment, build)
    if not is_python:
        started = [path for path in programs_of(build) if path.name != "saca"]
    elif named and not any(path.name == "saca" for path in named):
        started = []  # it says what it starts, and that starts nothing
    else:
        started = programs_of(build)
    parts += [digest_of(path) for path in started]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


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
    trees = {"python": clone_digest(is_compiled),
             "program": clone_digest(lambda name: is_compiled(name) or name.endswith(".md"))}
    tests = all_tests(preset)
    keys = {test["name"]: key_of(test, build, trees) for test in tests}
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
