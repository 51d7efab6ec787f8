"""`saca danger dataset`."""

import hashlib
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

SMALL = ["--transitions", "2500", "--part-drives", "4", "--no-tables"]


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.glob("part_*.h5"))}


def test_makes_the_same_whatever_the_threads_and_goes_on_where_it_was(tmp_path):
    first = saca("danger", "dataset", tmp_path / "a", *SMALL, "--threads", "1", "--json", cwd=tmp_path)
    assert first.returncode == SUCCESS, first.stderr
    told = json.loads(first.stdout)
    assert told["danger.dataset.transitions"] >= 2500
    made = digests(tmp_path / "a")
    assert told["danger.dataset.drives"] == 4 * len(made)
    assert told["danger.dataset.situations"] == 40 * len(made)
    assert "simulated" in (tmp_path / "a" / "README.md").read_text()

    other = saca("danger", "dataset", tmp_path / "b", *SMALL, "--threads", "3", cwd=tmp_path)
    assert other.returncode == SUCCESS, other.stderr
    assert digests(tmp_path / "b") == made

    last = sorted((tmp_path / "a").glob("part_*.h5"))[-1]
    last.unlink()
    again = saca("danger", "dataset", tmp_path / "a", *SMALL, cwd=tmp_path)
    assert again.returncode == SUCCESS, again.stderr
    assert digests(tmp_path / "a") == made


@pytest.mark.parametrize("arguments, code, wanted", [
    (["--transitions", "0"], WRONG_COMMAND_LINE, "--transitions"),
    (["--car", "no_such_car"], BAD_INPUT, "no_such_car"),
])
def test_refuses_what_makes_no_data(tmp_path, arguments, code, wanted):
    result = saca("danger", "dataset", tmp_path / "a", *arguments, cwd=tmp_path)
    assert wanted in one_error(result, code)
    assert not digests(tmp_path)


def test_other_settings_are_another_data_set(tmp_path):
    assert saca("danger", "dataset", tmp_path, *SMALL, cwd=tmp_path).returncode == SUCCESS
    result = saca("danger", "dataset", tmp_path, *SMALL, "--seed", "2", cwd=tmp_path)
    assert "journal.txt" in one_error(result, BAD_INPUT)


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("no folder")
    result = saca("danger", "dataset", tmp_path / "file" / "a", *SMALL, cwd=tmp_path)
    assert "file/a" in one_error(result, CANNOT_WRITE)
