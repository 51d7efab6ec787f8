"""Whether two tables of examples/reflex_in_c tell of the same drives: the same plan, begun at the same look, and an end that
differs by rounding alone.

usage: same_drives.py TABLE TABLE
Exit code 1: they differ by more than the bounds below, which are told with the largest difference.
"""
import csv
import sys

SAME = ("situation", "speed_m_s", "grip", "policy", "strength", "begun_s")
# A drive lasts 6,000 steps, some of them at the edge of a wheel that locks: what the libraries' sines differ in last digits grows.
BOUNDS = {"x_m": 1e-3, "y_m": 1e-3, "yaw_rad": 1e-3, "end_speed_m_s": 1e-3}


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows or set(rows[0]) != {*SAME, *BOUNDS}:
        raise ValueError(f"{path}: want rows of {', '.join((*SAME, *BOUNDS))}")
    return rows


def compare(here, there):
    """The differences that are too large, in words, and the largest of each column."""
    if len(here) != len(there):
        return [f"want {len(here)} drives, got {len(there)}"], {}
    faults = []
    for number, (a, b) in enumerate(zip(here, there), 2):
        faults += [f"line {number}: {column}: {a[column]} and {b[column]}" for column in SAME if a[column] != b[column]]
    largest = {}
    for column, bound in BOUNDS.items():
        apart = [abs(float(a[column]) - float(b[column])) for a, b in zip(here, there)]
        largest[column] = max(apart, key=lambda one: (one != one, one))  # what is no number is the worst
        if not largest[column] <= bound:
            faults.append(f"{column}: differs by {largest[column]:g}, want at most {bound:g}")
    return faults, largest


def main(arguments):
    if len(arguments) != 2:
        print("usage: same_drives.py TABLE TABLE", file=sys.stderr)
        return 2
    try:
        here, there = map(rows_of, arguments)
    except (OSError, ValueError) as error:
        print(f"same_drives: error: {error}", file=sys.stderr)
        return 3
    faults, largest = compare(here, there)
    for fault in faults:
        print(f"same_drives: error: {fault}", file=sys.stderr)
    print(f"{len(here)} drives; largest differences: " + ", ".join(f"{column} {value:g}" for column, value in largest.items()))
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
