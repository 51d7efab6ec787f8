#!/usr/bin/env python3
"""What the memories of other cars of the same make bring a car: cases are dealt among vehicles, encounter by encounter, and the banks of 1, 2, 4
... of them, joined, are asked about scenes that none of them has met.

usage: tools/fleet.py CASES QUERIES... [--vehicles 16] [--seed 1] [--json]
  CASES    what `saca memory build` or `export` wrote, plain or compressed
  QUERIES  likewise, of other encounters

An encounter and its twin without risk belong to one vehicle. Each number of vehicles is tried with as many groups as there are, at most four;
of these the mean and the least and largest are told. A lone vehicle's memory is what it has learnt by itself.
"""

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from shippable_cases import read_cases

ROOT = pathlib.Path(__file__).resolve().parent.parent
SACA = os.environ.get("SACA_PROGRAM", ROOT / "build" / "release" / "saca")
MOST_GROUPS = 4
SURE = "memory.transfer.check.above_0.9."


def vehicle_of(case, vehicles, seed):
    """Which vehicle meets the encounter of a case, from 0 on."""
    encounter = case["source"].removesuffix("_twin")
    return int.from_bytes(hashlib.sha256(f"{seed} {encounter}".encode()).digest()[:8], "big") % vehicles


def asked(cases, header, queries, folder):
    """@return  how many queries the bank of these cases is sure of (share), and how often it is right then"""
    if not cases:
        return {"cases": 0, "coverage": 0.0, "right": None, "sure": 0}
    bank = pathlib.Path(folder) / "bank.jsonl"
    bank.write_text("".join(json.dumps(line) + "\n" for line in [header | {"cases": len(cases)}, *cases]), encoding="utf-8")
    command = [SACA, "memory", "calibrate", bank, *(part for query in queries for part in ("--check", query)), "--json"]
    run = subprocess.run(command, check=False, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"saca memory calibrate: {run.stderr.strip()}")
    figures = json.loads(run.stdout)
    sure = figures.get(SURE + "in_truth.n", 0)
    return {"cases": len(cases), "coverage": figures[SURE + "coverage"], "right": figures[SURE + "in_truth"] if sure else None, "sure": sure}


def fleet(path, queries, vehicles, seed):
    """@return  a row for each number of vehicles"""
    header, cases = read_cases(path)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        joined = 1
        while joined <= vehicles:
            groups = [range(first, first + joined) for first in range(0, vehicles - joined + 1, joined)][:MOST_GROUPS]
            told = [asked([case for case in cases if vehicle_of(case, vehicles, seed) in group], header, queries, folder) for group in groups]
            rows.append({"vehicles": joined, "groups": told})
            joined *= 2
    return rows


def row_text(row):
    def spread(key, digits, factor=1.0):
        values = [factor * one[key] for one in row["groups"] if one[key] is not None]
        return f"{sum(values) / len(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})" if values else "-"

    return f"{row['vehicles']:8}  {spread('cases', 0):24}  {spread('coverage', 1, 100.0):22}  {spread('right', 1, 100.0):22}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("queries", type=pathlib.Path, nargs="+")
    parser.add_argument("--vehicles", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.vehicles < 1:
        parser.error("--vehicles: want at least 1")
    missing = next((path for path in (options.cases, *options.queries) if not path.is_file()), None)
    if missing is not None:
        sys.exit(f"{missing}: want a file of cases, got none")
    rows = fleet(options.cases, options.queries, options.vehicles, options.seed)
    if options.json:
        print(json.dumps({"schema": "saca.fleet/1", "vehicles": rows}))
        return
    print("vehicles  cases                     sure of, % of scenes    right then, %")
    for row in rows:
        print(row_text(row))


if __name__ == "__main__":
    main()
