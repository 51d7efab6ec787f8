"""Runs beside a language model: its replies recorded and given again, and what happens when it is struck."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: F401, a fixture
from program import PROGRAM, ROOT, SUCCESS, saca

HOST = pathlib.Path(PROGRAM).parent / "saca-model-host"
HAS_MODEL = HOST.exists() and (ROOT / "third_party/models/choice.json").exists()
needs_model = pytest.mark.skipif(not HAS_MODEL, reason="`make model` has not been run")


def replayed(scenario, *more, cwd):
    """A run whose replies are recorded, and one that is given them. Both have the same answers, and some."""
    replies = cwd / "replies.json"
    first = saca("run", scenario, "--pace", "lockstep", "--record-replies", replies, "--json", *more, cwd=cwd)
    again = saca("run", scenario, "--pace", "lockstep", "--llm",
                 f"replay:{replies}", "--json", cwd=cwd)
    assert first.returncode == again.returncode == SUCCESS, first.stderr + again.stderr
    answers = [[preview["reasoning"] for preview in json.loads(run.stdout)["previews"]]
               for run in (first, again)]
    assert answers[0] == answers[1]
    assert any(answers[0])


@needs_model
def test_recorded_replies_can_be_replayed(tmp_path):
    replayed("one_way", cwd=tmp_path)


def test_recorded_replies_of_several_forecasts_can_be_replayed(server, tmp_path):
    replayed("100car_8676", "--llm", f"some-model@http://127.0.0.1:{server.server_port}/v1", cwd=tmp_path)


def descendants(pid):
    """Processes begun by a process, and by those."""
    found = []
    for child in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        for each in child.read_text().split():
            found += [int(each), *descendants(each)]
    return found


@needs_model
@pytest.mark.parametrize("struck_by", [signal.SIGKILL, signal.SIGSTOP])
def test_a_model_that_is_struck_in_the_middle_changes_nothing_on_the_reflex_plane(struck_by, tmp_path):
    # What the model would say here is refused, so that it brakes whatever it hears; it is over after seconds.
    run = subprocess.Popen([PROGRAM, "run", "one_way"], cwd=tmp_path, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    story, struck = [], []
    for line in run.stdout:
        story.append(line)
        if not struck and "the model is asked" in line:
            struck = descendants(run.pid)
            for child in struck:
                os.kill(child, struck_by)
    assert run.wait(timeout=1500) == SUCCESS, run.stderr.read()
    assert any("policy 0 AEB" in line for line in story)
    assert (tmp_path / "runs/one_way/report.html").exists()
    if not struck:
        pytest.skip("this machine was too busy to ask the model before the trigger")
    assert any("thinking" in line and "model: " in line for line in story), story


SMALL_WEIGHTS = ROOT / "third_party" / "models" / "saca-SmolLM2-135M.Q8_0.gguf"


@pytest.mark.skipif(not HOST.exists() or not SMALL_WEIGHTS.exists(), reason="llama.cpp and its smallest weights are not here")
def test_the_models_process_ends_with_the_one_that_began_it():
    """Also where somebody else still holds its input open."""
    reader, writer = os.pipe()
    begin = "import subprocess, sys, time; print(subprocess.Popen(sys.argv[1:], stdin=0, stdout=subprocess.DEVNULL).pid, flush=True); time.sleep(1000)"
    parent = subprocess.Popen([sys.executable, "-c", begin, HOST, "--model", SMALL_WEIGHTS], stdin=reader, stdout=subprocess.PIPE, text=True)
    child = pathlib.Path("/proc") / parent.stdout.readline().strip()

    def lives():
        return child.exists() and "\nState:\tZ" not in (child / "status").read_text()

    def watches():  # it catches the signal that tells of its parent's end
        caught = next(line for line in (child / "status").read_text().splitlines() if line.startswith("SigCgt"))
        return int(caught.split()[1], 16) >> (signal.SIGUSR1 - 1) & 1

    while not watches():
        time.sleep(0.01)
    time.sleep(0.1)
    assert lives()
    parent.kill()
    parent.wait()
    end = time.monotonic() + 100
    while lives() and time.monotonic() < end:
        time.sleep(0.01)
    assert not lives()
    os.close(reader)
    os.close(writer)
