"""saca-train-places: from encounters of the tuning split to weights, the same bytes each time."""
import json
import pathlib
import signal
import struct
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, ROOT, SUCCESS

TRAIN = pathlib.Path(PROGRAM).parent / "saca-train-places"
pytestmark = pytest.mark.skipif(not TRAIN.exists(), reason="saca-train-places is built where libtorch is found")
FEW = ["--encounters", "6"]


def train(output, *arguments):
    return subprocess.run([str(TRAIN), "--output", str(output), *FEW, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=600)


def test_the_same_seed_gives_the_same_weights_and_says_what_they_have_seen(tmp_path):
    for name, more in (("a", []), ("b", ["--threads", "2"]), ("c", ["--seed", "2"])):
        run = train(tmp_path / name, "--epochs", "2", *more)
        assert run.returncode == SUCCESS, run.stderr
    a, b, c = ((tmp_path / name).read_bytes() for name in "abc")
    assert a == b and a != c
    size = struct.unpack("<Q", a[:8])[0]
    header = json.loads(a[8:8 + size])
    assert header["__metadata__"] == {"drives": "0", "encounters": "6", "epochs": "2", "left_out": "nothing", "seed": "1"}
    assert header["output.weight"]["shape"] == [51, 96]
    curve = (tmp_path / "a.curve.csv").read_text().splitlines()
    assert curve[0] == "epoch,training_loss,held_out_loss,seconds" and len(curve) == 3
    assert not (tmp_path / "a.state").exists()


def test_a_training_that_was_stopped_goes_on_to_the_same_weights(tmp_path):
    assert train(tmp_path / "straight", "--epochs", "6").returncode == SUCCESS
    command = [str(TRAIN), "--output", str(tmp_path / "stopped"), *FEW, "--epochs", "6"]
    run = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while "epoch 1 of 6" not in run.stdout.readline():
        assert run.poll() is None
    run.send_signal(signal.SIGINT)
    _, told = run.communicate(timeout=600)
    assert run.returncode == INTERRUPTED and "goes on from here" in told
    assert not (tmp_path / "stopped").exists() and (tmp_path / "stopped.state").exists()
    assert train(tmp_path / "stopped", "--epochs", "6").returncode == SUCCESS
    assert (tmp_path / "stopped").read_bytes() == (tmp_path / "straight").read_bytes()


@pytest.mark.parametrize("arguments, code, words", [
    (["--data", "no/such/folder"], BAD_INPUT, "no/such/folder"),
    (["--root", "no/such/folder"], BAD_INPUT, "no/such/folder"),
])
def test_what_cannot_be_read_is_refused(tmp_path, arguments, code, words):
    run = train(tmp_path / "w", *arguments)
    assert run.returncode == code and words in run.stderr and run.stderr.startswith("saca-train-places: error: ")


def test_weights_that_cannot_be_written_are_refused(tmp_path):
    run = train(tmp_path / "no/such/w", "--epochs", "1")
    assert run.returncode == CANNOT_WRITE and "no/such/w" in run.stderr
