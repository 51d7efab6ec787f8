#!/usr/bin/env python3
"""Cases as they are shipped: without those of recorded emergencies that are shipped as scenarios, numbers to five digits, compressed.

usage: tools/shippable_cases.py CASES.jsonl OUT.jsonl[.gz]

Features of scenes differ by less than a thousandth of what makes a difference for it. The same cases give the same bytes.
"""

import gzip
import json
import pathlib
import sys
import zlib

from figures import ROOT, write_whole


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(each) for key, each in value.items()}
    return [rounded(each) for each in value] if isinstance(value, list) else value


def read_cases(path):
    """@return  the header of a file of cases, plain or compressed, which says how many follow, and the cases"""
    try:
        with gzip.open(path, "rt", encoding="utf-8") if path.suffix == ".gz" else path.open(encoding="utf-8") as lines:
            header, *cases = [json.loads(line) for line in lines]
    except OSError as problem:
        sys.exit(f"{path}: want a file of cases, got {problem.strerror or problem}")
    except (EOFError, zlib.error) as problem:
        sys.exit(f"{path}: want a whole compressed file, got {problem}")
    except ValueError as problem:
        sys.exit(f"{path}: want cases as JSON Lines, got {problem}")
    if not isinstance(header, dict) or header.get("schema") != "saca.cases/1" or "cases" not in header:
        sys.exit(f"{path}:1: want a header, schema saca.cases/1, that says how many cases follow")
    if header["cases"] != len(cases):
        sys.exit(f"{path}: want {header['cases']} cases, as the header says, got {len(cases)}: it is cut or was lengthened")
    for number, case in enumerate(cases, start=2):
        if not isinstance(case, dict) or "source" not in case:
            sys.exit(f'{path}:{number}: want a case with its "source", got none')
    return header, cases


def shippable(header, cases, shipped):
    """The lines of a file of cases."""
    kept = [case for case in cases if not any(name in case["source"] for name in shipped)]
    header["cases"] = len(kept)
    return [json.dumps(rounded(line), separators=(",", ":")) for line in [header, *kept]]


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: tools/shippable_cases.py CASES.jsonl OUT.jsonl[.gz]")
    source, target = (pathlib.Path(argument) for argument in sys.argv[1:])
    shipped = {path.stem for path in (ROOT / "scenarios").glob("100car_*.toml")}
    text = "".join(line + "\n" for line in shippable(*read_cases(source), shipped))
    data = text.encode("utf-8")
    write_whole(target, gzip.compress(data, compresslevel=9, mtime=0) if target.suffix == ".gz" else data)


if __name__ == "__main__":
    main()
