#!/usr/bin/env python3
"""Time from starting a run until the encounter begins, and the memory of its two processes.

usage: start_time.py PROGRAM SCENARIO
Prints {"run.start_s": ..., "run.saca_rss_mib": ..., "run.model_rss_mib": ...} as JSON. The encounter
begins with the first line of the story after the headline's empty line.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time


def resident_mib(pid):
    """Resident memory of a process now, 0 when it is gone."""
    try:
        text = pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0.0
    return next((int(line.split()[1]) / 1024 for line in text.splitlines() if line.startswith("VmRSS")), 0.0)


def children(pid):
    return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def main(program, scenario):
    program = pathlib.Path(shutil.which(program) or program).resolve()
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        run = subprocess.Popen([program, "run", scenario], stdout=subprocess.PIPE, text=True, cwd=folder)
        figures = {}
        for line in run.stdout:
            if not figures:
                if line != "\n":
                    continue  # the headline tells of T1, too
                figures["run.start_s"] = round(time.monotonic() - begin, 3)
            elif "trigger" in line or "T1:" in line:
                figures["run.saca_rss_mib"] = round(resident_mib(run.pid), 1)
                figures["run.model_rss_mib"] = round(sum(map(resident_mib, children(run.pid))), 1)
        code = run.wait()
    print(json.dumps(figures, indent=1))
    return code


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
