"""The program under test, its exit codes, and how an error looks."""
import json
import os
import pathlib
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(os.environ.get("SACA_PROGRAM", ROOT / "build/release/saca")).resolve())
SUCCESS, WRONG_COMMAND_LINE, BAD_INPUT, CANNOT_WRITE, NOT_THE_SAME, NOTHING_TO_DECIDE, TOO_SLOW, INTERRUPTED = 0, 2, 3, 4, 6, 7, 8, 130


def saca(*arguments, cwd, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          timeout=1500, **options)


def quick(*arguments, cwd, **options):
    """A run without model, at the fast pace."""
    return saca("run", *arguments, "--llm", "off", "--pace", "lockstep", cwd=cwd, **options)


def interrupted_while_silent(server, *arguments, cwd):
    """What a run says when it is interrupted while the model that it has asked keeps it waiting."""
    server.silent = True
    run = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not server.asked:
        assert run.poll() is None, run.stderr.read()
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    _, told = run.communicate(timeout=100)  # the model has two minutes
    assert run.returncode == INTERRUPTED
    return told


def one_error(run, code):
    """The one line on the error stream of a run that was refused."""
    assert run.returncode == code, run.stderr
    lines = run.stderr.strip().splitlines()
    assert len(lines) == 1, run.stderr
    return lines[0]


def figures(run):
    """What a run with `--json` printed."""
    assert run.returncode == SUCCESS, run.stderr
    return json.loads(run.stdout)
