"""Draws the loss over the steps of a training, or of several of which each went on with the last.

usage: curve.py CURVE... OUTPUT
  CURVE   of fine_tune.py: curve.csv
  OUTPUT  the picture (.svg), or all of them as one curve (.csv): steps, tokens and seconds are counted on
"""
import csv
import math
import os
import pathlib
import sys

WIDTH, HEIGHT = 720, 300
LEFT, RIGHT, TOP, BOTTOM = 56, 16, 16, 44
SMOOTHED_OVER = 10  # steps, the newest last


COLUMNS = ("step", "tokens", "loss", "calibration_loss", "seconds")


def read_rows(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [{"step": int(row["step"]), "tokens": int(row["tokens"]), "loss": float(row["loss"]),
                     "calibration_loss": float(row["calibration_loss"]) if row["calibration_loss"] else "", "seconds": float(row["seconds"])}
                    for row in csv.DictReader(file)]
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise SystemExit(f"curve: error: {path}: want a training's curve (columns {', '.join(COLUMNS)}): {error!r}") from None
    if not rows or min(row["loss"] for row in rows) <= 0 or min(row["calibration_loss"] or 1.0 for row in rows) <= 0:
        raise SystemExit(f"curve: error: {path}: want steps with losses above 0")
    return rows


def joined(curves):
    """One curve after the other: what is counted goes on from where the last ended."""
    rows = []
    for curve in curves:
        last = rows[-1] if rows else {"step": 0, "tokens": 0, "seconds": 0.0}
        rows += [row | {key: row[key] + last[key] for key in ("step", "tokens")} | {"seconds": round(row["seconds"] + last["seconds"], 1)} for row in curve]
    return rows


def read_curve(*paths):
    """Steps, their loss, and the judged losses by step."""
    rows = joined([read_rows(path) for path in paths])
    return [(row["step"], row["loss"]) for row in rows], [(row["step"], row["calibration_loss"]) for row in rows if row["calibration_loss"]]


def write_joined(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def smoothed(losses):
    values = [loss for _, loss in losses]
    means = [sum(part) / len(part) for part in (values[max(0, i + 1 - SMOOTHED_OVER):i + 1] for i in range(len(values)))]
    return [(step, mean) for (step, _), mean in zip(losses, means)]


def ticks(low, high):
    """1, 2, 5 of each power of ten between two values."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [factor * 10.0**power for power in powers for factor in (1, 2, 5) if low <= factor * 10.0**power <= high]


def picture(losses, judged):
    last = losses[-1][0]
    values = [loss for _, loss in losses + judged]
    low, high = min(values) / 1.1, max(values) * 1.1
    x = lambda step: LEFT + (WIDTH - LEFT - RIGHT) * step / last
    y = lambda loss: TOP + (HEIGHT - TOP - BOTTOM) * math.log(high / loss) / math.log(high / low)
    line = lambda points: " ".join(f"{x(step):.1f},{y(loss):.1f}" for step, loss in points)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for loss in ticks(low, high):
        parts += [f'<path d="M{LEFT} {y(loss):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>',
                  f'<text x="{LEFT - 8}" y="{y(loss) + 4:.1f}" text-anchor="end" fill="#444">{loss:g}</text>']
    for step in range(0, last + 1, max(1, 10 ** (len(str(last)) - 1) // 2)):
        parts.append(f'<text x="{x(step):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle" fill="#444">{step}</text>')
    parts += [f'<circle cx="{x(step):.1f}" cy="{y(loss):.1f}" r="1.4" fill="#9db8d9"/>' for step, loss in losses]
    parts += [f'<polyline points="{line(smoothed(losses))}" fill="none" stroke="#1f5fa8" stroke-width="1.6"/>']
    parts += [f'<circle cx="{x(step):.1f}" cy="{y(loss):.1f}" r="4" fill="none" stroke="#c0392b" stroke-width="1.6"/>' for step, loss in judged]
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts += [f'<text x="{middle:.0f}" y="{HEIGHT - 8}" text-anchor="middle" fill="#444">step</text>',
              f'<text x="{WIDTH - RIGHT}" y="{TOP + 14}" text-anchor="end" fill="#1f5fa8">loss on replies: of each step, and over {SMOOTHED_OVER}</text>',
              f'<text x="{WIDTH - RIGHT}" y="{TOP + 30}" text-anchor="end" fill="#c0392b">on cases kept from training</text>', "</svg>"]
    return "\n".join(parts) + "\n"


def main(arguments):
    if len(arguments) < 2:
        raise SystemExit(__doc__)
    *curves, output = arguments
    if any(os.path.exists(path) and os.path.exists(output) and os.path.samefile(path, output) for path in curves):
        raise SystemExit(f"curve: error: {output}: want another file than the curves that are read")
    try:
        if output.endswith(".csv"):
            write_joined(output, joined([read_rows(path) for path in curves]))
        else:
            pathlib.Path(output).write_text(picture(*read_curve(*curves)), encoding="utf-8")
    except OSError as error:
        raise SystemExit(f"curve: error: {output}: cannot write: {error.strerror}") from None


if __name__ == "__main__":
    main(sys.argv[1:])
