#!/usr/bin/env python3
"""Merges flat JSON objects of figures into one, with when, where and from which commit.

usage: merge_figures.py FILE...
"""
import datetime
import json
import pathlib
import subprocess
import sys


def processor():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


def merged(files):
    figures = {}
    for file in files:
        for name, value in json.loads(pathlib.Path(file).read_text()).items():
            if name in figures and not name.startswith("meta."):
                raise SystemExit(f"{file}: {name} is measured twice")
            figures[name] = value
    return figures


def main(files):
    figures = merged(files)
    figures["meta.date"] = datetime.date.today().isoformat()
    figures["meta.processor"] = processor()
    figures["meta.commit"] = subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    figures["meta.command"] = "make bench"
    print(json.dumps(figures, indent=1, sort_keys=True))


if __name__ == "__main__":
    main(sys.argv[1:])
