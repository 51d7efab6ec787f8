"""Going through encounters one after the other, and remembering them."""
import fcntl
import json
import os
import pathlib
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, WRONG_COMMAND_LINE, figures, one_error, saca

COUNT, SEEDS = 4, 2
COMMAND = ("learn", "balanced", "--count", COUNT, "--seeds", SEEDS, "--empty-memory", "--lies", 0.5)


@pytest.fixture(scope="module")
def taught(tmp_path_factory):
    folder = tmp_path_factory.mktemp("learn")
    run = saca(*COMMAND, "-o", "way", "--svg", "curve.svg", "--json", cwd=folder)
    return folder, figures(run)


def verified(folder, bank):
    return figures(saca("memory", "--memory", bank, "verify", "--json", cwd=folder))


def test_figures_belong_together(taught):
    folder, told = taught
    head = "learn.balanced."
    assert told[head + "episodes"] == COUNT and told[head + "seeds"] == SEEDS and told[head + "faults"] == 0
    for method, other in (("learning", "frozen"), ("poisoned", "frozen"), ("corrected", "drawn")):
        over = told[f"{head}{method}.harm_over_{other}"]
        assert over == pytest.approx(told[f"{head}{method}.harm"] - told[f"{head}{other}.harm"], abs=2e-4)
    assert told[head + "frozen.cases"] == 0 and 0 < told[head + "learning.cases"] <= COUNT
    assert all(told[f"{head}{who}.regret"] >= -0.05 for who in ("frozen", "learning", "drawn", "aeb"))
    assert told[head + "aeb.harm.n"] == SEEDS
    assert "Learning from encounters" in (folder / "curve.svg").read_text()


def test_each_bank_holds_what_was_met(taught):
    folder, told = taught
    sizes = [verified(folder, f"way/seed-{k + 1}/learning.sqlite")["cases"] for k in range(SEEDS)]
    assert sum(sizes) / SEEDS == pytest.approx(told["learn.balanced.learning.cases"])
    shown = json.loads(saca("memory", "--memory", "way/seed-1/learning.sqlite", "show", "1", cwd=folder).stdout)
    assert "origin" not in shown["details"] and "; best " in shown["review"]  # its own


def test_interrupted_it_goes_on_to_the_same_end(taught, tmp_path):
    folder, told = taught
    (tmp_path / "way").mkdir()
    lines = (folder / "way/episodes.journal").read_text().splitlines(keepends=True)
    assert len(lines) == 1 + COUNT
    (tmp_path / "way/episodes.journal").write_text("".join(lines[:3]) + lines[3][:100])
    again = figures(saca(*COMMAND, "-o", "way", "--threads", 1, "--json", cwd=tmp_path))
    assert again == told
    assert figures(saca(*COMMAND, "-o", "way", "--json", cwd=tmp_path)) == told  # nothing is left to be played
    assert (tmp_path / "way/episodes.journal").read_text() == "".join(lines)


def test_the_bank_that_it_begins_with_stays_as_it_is(taught, tmp_path):
    folder, _ = taught
    shutil.copy(folder / "way/seed-1/learning.sqlite", tmp_path / "mine.sqlite")
    before = verified(tmp_path, "mine.sqlite")
    told = figures(saca("learn", "balanced", "--count", 2, "--seeds", 1, "--memory", "mine.sqlite", "-o", "way", "--json", cwd=tmp_path))
    assert told["learn.balanced.frozen.cases"] == before["cases"]
    assert verified(tmp_path, "mine.sqlite") == before


def test_what_was_begun_otherwise_stays_as_it_was(taught, tmp_path):
    folder, _ = taught
    inside = saca("learn", "balanced", "--memory", folder / "way/seed-1/learning.sqlite", "-o", folder / "way", cwd=tmp_path)
    assert "--memory" in one_error(inside, BAD_INPUT)
    before = verified(folder, "way/seed-1/learning.sqlite")
    told = one_error(saca(*COMMAND[:-1], 0.1, "-o", folder / "way", cwd=tmp_path), BAD_INPUT)
    assert "episodes.journal" in told
    assert verified(folder, "way/seed-1/learning.sqlite") == before


def test_two_programs_do_not_learn_in_one_folder(taught, tmp_path):
    folder, told = taught
    journal = (folder / "way/episodes.journal").read_bytes()
    before = verified(folder, "way/seed-1/learning.sqlite")
    held = os.open(folder / "way", os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)  # as the other program does for as long as it learns
    said = one_error(saca(*COMMAND, "-o", folder / "way", cwd=tmp_path), CANNOT_WRITE)
    assert str(folder / "way") in said and "another program" in said
    assert (folder / "way/episodes.journal").read_bytes() == journal
    assert verified(folder, "way/seed-1/learning.sqlite") == before
    os.close(held)
    assert figures(saca(*COMMAND, "-o", folder / "way", "--json", cwd=tmp_path)) == told


def test_what_cannot_be_done_is_refused(tmp_path):
    assert "none.sqlite" in one_error(saca("learn", "balanced", "--memory", "none.sqlite", cwd=tmp_path), BAD_INPUT)
    assert "balancd" in one_error(saca("learn", "balancd", cwd=tmp_path), BAD_INPUT)
    for lies in (2, "nan"):
        assert saca("learn", "balanced", "--lies", lies, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert saca("learn", "balanced", "--memory", "a", "--empty-memory", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    (tmp_path / "one").mkdir()
    shutil.copy(ROOT / "scenarios/one_way.toml", tmp_path / "one")
    assert "want an encounter for each of 5 seeds, got 1" in one_error(saca("learn", "one", cwd=tmp_path), BAD_INPUT)
