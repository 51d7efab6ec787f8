#!/usr/bin/env python3
"""Figures that a command printed as JSON, with where they come from: what the scripts that keep them and make pages of them share.

usage: tools/figures.py keep FILE COMMAND COMMIT SECONDS    what COMMAND printed, on standard input, becomes FILE
       tools/figures.py is_there FILE COMMAND COMMIT        succeeds if FILE holds what COMMAND printed at COMMIT
"""

import datetime
import json
import os
import pathlib
import platform
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Figures(dict):
    """Figures by name, from one run. One that is missing ends the script; those that were asked for are remembered."""

    def __init__(self, values, where):
        super().__init__(values)
        self.where = where
        self.read = set()

    def __getitem__(self, key):
        self.read.add(key)
        return super().__getitem__(key)

    def __missing__(self, key):
        sys.exit(f"{self.where}: want the figure {key!r}, got none")


def read_json(path):
    """What a file has as JSON. One that cannot be read ends the script."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except OSError as problem:
        sys.exit(f"{path}: want a file of figures, got {problem.strerror}")
    except ValueError as problem:
        sys.exit(f"{path}: want JSON, got {problem}")


def read_figures(path, key):
    """Figures by name. Without the one named `key` the script ends."""
    figures = read_json(path)
    if not isinstance(figures, dict) or key not in figures:
        sys.exit(f'{path}: want figures with "{key}", got none')
    return figures


def write_whole(path, data):
    """Writes bytes as a file, whole or not at all."""
    unfinished = pathlib.Path(f"{path}.part")
    unfinished.write_bytes(data)
    unfinished.rename(path)


def flat(document, head=""):
    """Nested objects and lists as one object: {"a": [{"b": 1}]} becomes {"a.0.b": 1}."""
    figures = {}
    for key, value in document.items() if isinstance(document, dict) else enumerate(document):
        figures |= flat(value, f"{head}{key}.") if isinstance(value, (dict, list)) else {f"{head}{key}": value}
    return figures


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def by_name(document):
    """What Google's benchmarks print, as {name: {"cpu_time_us": ...}}; anything else as it is."""
    if "benchmarks" not in document:
        return document
    in_us = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}
    found = {}
    for one in document["benchmarks"]:
        if one.get("error_occurred"):
            found[one["name"]] = {"error": one["error_message"]}
        else:
            factor = in_us[one["time_unit"]]
            found[one["name"]] = {"cpu_time_us": factor * one["cpu_time"], "real_time_us": factor * one["real_time"],
                                  "items_per_second": one.get("items_per_second")}
    return found


def keep(file, command, commit, seconds):
    text = sys.stdin.read()
    try:
        document = json.loads(text)
    except json.JSONDecodeError as problem:
        sys.exit(f"{command}: want JSON, got {text[:60]!r} ({problem})")
    meta = {"meta.name": pathlib.Path(file).stem, "meta.command": command, "meta.commit": commit, "meta.seconds": int(seconds),
            "meta.date": datetime.date.today().isoformat(), "meta.processor": processor(), "meta.cores": os.cpu_count()}
    write_whole(file, (json.dumps(by_name(document) | meta, indent=0, sort_keys=True) + "\n").encode())


def is_there(file, command, commit):
    try:
        kept = json.loads(pathlib.Path(file).read_text())
    except (OSError, json.JSONDecodeError):
        return False
    return kept.get("meta.command") == command and kept.get("meta.commit") == commit


def table(head, lines):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(line) + " |" for line in lines)])


def interval(figures, key, digits=4, factor=1.0):
    """A figure with its bounds, where it has some: `0.50 (0.40 to 0.60)`."""
    if key not in figures:
        return "-"
    text = f"{factor * figures[key]:,.{digits}f}"
    if key + ".lo" not in figures:
        return text
    return f"{text} ({factor * figures[key + '.lo']:,.{digits}f} to {factor * figures[key + '.hi']:,.{digits}f})"


def percent(figures, key):
    return "-" if key not in figures else f"{100.0 * figures[key]:.1f}"


def main(words):
    if len(words) == 5 and words[0] == "keep":
        keep(*words[1:])
    elif len(words) == 4 and words[0] == "is_there":
        sys.exit(0 if is_there(*words[1:]) else 1)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
