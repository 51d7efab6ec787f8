"""What comes from outside and means no good: one clear error, in time, and no command for the terminal."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: F401, a fixture
from program import BAD_INPUT, CANNOT_WRITE, PROGRAM, ROOT, SUCCESS, one_error, quick, saca

CLEAR = "\x1b[2J\x9b2J\r"  # commands of terminals


def said(*arguments, cwd, **environment):
    """All bytes that a program says, and its exit code."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         env={**os.environ, **environment}, timeout=1500)
    return run.stdout, run.returncode


def holds_a_command(told):
    return re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f]", told.decode()) is not None


@pytest.mark.parametrize("arguments", [
    ("explain", CLEAR), ("run", CLEAR + ".toml"), (CLEAR,), ("run", "--pace", CLEAR), ("memory", "list", CLEAR + ".db"),
    ("vehicle", "fit", CLEAR, "--car", CLEAR)])
def test_no_argument_commands_the_terminal(arguments, tmp_path):
    told, code = said(*arguments, cwd=tmp_path)
    assert code != SUCCESS and told and not holds_a_command(told)


def test_no_scenario_commands_the_terminal(tmp_path):
    text = (ROOT / "scenarios" / "one_way.toml").read_text()
    loud = re.sub("^title = .*$", lambda _: 'title = "a \\\\u001B[2J\\\\u009B2J title"'.replace("\\\\", "\\"), text, count=1, flags=re.M)
    assert loud != text
    (tmp_path / "loud.toml").write_text(loud)
    told, code = said("run", "loud.toml", "--llm", "off", "--pace", "lockstep", cwd=tmp_path)
    assert code == SUCCESS and b"title" in told and not holds_a_command(told)


def test_no_model_commands_the_terminal_or_tells_its_key(server, tmp_path):
    key = "sk-0123456789abcdef"
    server.conclusion = f"{CLEAR} the key is {key}. Response to user: 6"
    name = f"some-model@http://127.0.0.1:{server.server_address[1]}/v1"
    told, code = said("reason", "100car_8456", "--llm", name, cwd=tmp_path, SACA_LLM_KEY=key)
    assert code == SUCCESS and b"the key is ***" in told and not holds_a_command(told), told
    assert key.encode() not in told


def test_what_is_no_scenario_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    with open(tmp_path / "long.toml", "wb") as file:
        file.truncate(10 << 30)  # a hole
    (tmp_path / "deep.toml").write_text("a" + ".a" * 300_000 + " = 1\n")
    (tmp_path / "lists.toml").write_text("a = " + "[" * 300_000)
    for name, words in (("pipe.toml", "is a pipe"), ("long.toml", "want at most"), ("deep.toml", "deep.toml:1: want keys"),
                        ("lists.toml", "lists.toml:1: want arrays"), ("/dev/zero", "is a device")):
        assert words in one_error(quick(name, cwd=tmp_path), BAD_INPUT)


@pytest.mark.parametrize("what", ["[" * 500_000, '{"schema": "saca.record/1", "a": ' + "[" * 500_000])
def test_nested_json_is_refused(what, tmp_path):
    (tmp_path / "deep.json").write_text(what)
    for command in ("explain", "replay"):
        assert "deep.json" in one_error(saca(command, "deep.json", cwd=tmp_path), BAD_INPUT)


@pytest.mark.parametrize("command", [
    ("vehicle", "test-drive", "brake", "--output"), ("reach", "solve", "paper_ellipse", "--output")])
def test_what_is_no_file_is_not_replaced(command, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    one_error(saca(*command, "pipe", cwd=tmp_path), CANNOT_WRITE)
    assert (tmp_path / "pipe").is_fifo()
    os.symlink("/dev/full", tmp_path / "full")  # by a link: should this ever fail, the machine keeps its device
    one_error(saca(*command, "full", cwd=tmp_path), CANNOT_WRITE)
    assert (tmp_path / "full").is_char_device()
