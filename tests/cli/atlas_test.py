"""`saca atlas` and `saca bench atlas`."""
import pathlib
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, WRONG_COMMAND_LINE, one_error, saca


def test_an_interrupted_build_goes_on_where_it_was(tmp_path):
    def build_for(seconds):
        run = subprocess.Popen([PROGRAM, "atlas", "build", "--output", "own.atlas", "--threads", "1"], cwd=tmp_path,
                               stderr=subprocess.PIPE, text=True)
        time.sleep(seconds)
        run.send_signal(signal.SIGINT)
        _, told = run.communicate(timeout=60)
        assert run.returncode == INTERRUPTED, told
        assert "the same command goes on" in told.lower()
        return (tmp_path / "own.atlas.journal").read_bytes()

    first = build_for(1.5)
    again = build_for(1.5)
    assert not (tmp_path / "own.atlas").exists()
    assert again.startswith(first) and len(again) > len(first) > 1000
    # Nothing is driven twice.
    numbers = [line.split()[0] for line in again.decode().splitlines()[1:]]
    assert len(numbers) == len(set(numbers))


@pytest.mark.parametrize("text, wanted", [(b"", "cut short"), (b"x" * 50_000, "is no atlas")])
@pytest.mark.parametrize("command", [["atlas", "info"], ["atlas", "check"], ["bench", "atlas", "--atlas"]])
def test_what_is_no_atlas_is_said_in_one_line(text, wanted, command, tmp_path):
    (tmp_path / "bad.atlas").write_bytes(text)
    error = one_error(saca(*command, "bad.atlas", cwd=tmp_path), BAD_INPUT)
    assert wanted in error and "bad.atlas" in error


def test_what_cannot_be_done_is_said(tmp_path):
    assert "none.atlas" in one_error(saca("atlas", "info", "none.atlas", cwd=tmp_path), BAD_INPUT)
    assert "batmobile" in one_error(saca("atlas", "build", "--car", "batmobile", cwd=tmp_path), BAD_INPUT)
    (tmp_path / "file").write_text("")
    assert "file" in one_error(saca("atlas", "build", "--output", "file/a.atlas", cwd=tmp_path), CANNOT_WRITE)
    assert saca("atlas", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("atlas", "build", "--threads", 0, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
