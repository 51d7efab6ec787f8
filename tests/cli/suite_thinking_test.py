"""`saca suite` and `saca ladder` with memory and a language model."""
import html.parser
import json
import pathlib
import re
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: F401, a fixture
from program import BAD_INPUT, SUCCESS, figures, interrupted_while_silent, one_error, saca


@pytest.fixture(scope="module")
def taught(tmp_path_factory):
    """A memory of the encounters that the suite has, as SACA lived through them."""
    folder = tmp_path_factory.mktemp("taught")
    for number in range(4):
        words = saca("suite", "balanced", "--replay", number, cwd=folder).stdout.split()
        words.remove("--no-memory")
        run = saca(*words[1:], "--danger", "off", "--memory", "m.sqlite", "--empty-memory", "--json", cwd=folder)
        assert run.returncode == SUCCESS, run.stderr
    return folder / "m.sqlite"


def test_memory_is_asked_and_not_taught(taught, tmp_path):
    memory = pathlib.Path(shutil.copy(taught, tmp_path))
    before = memory.read_bytes()
    few = ("--memory", "m.sqlite", "--methods", "saca,saca_no_memory,aeb", "--count", 4, "--json", "--no-twins")
    told = figures(saca("suite", "balanced", *few, "--threads", 1, "--output", "a.h5", cwd=tmp_path))
    assert memory.read_bytes() == before
    place = "suite.balanced.saca."
    assert told[place + "memory_hits"] > 0 and told[place + "memory_hit_rate"] == pytest.approx(told[place + "memory_hits"] / told[place + "forecasts"])
    assert told[place + "cache_hit_rate"] == told.get(place + "source.memory", 0) / 4
    assert told["suite.balanced.saca_no_memory.memory_hits"] == 0
    assert told["suite.balanced.saca_no_memory.cache_hit_rate"] == 0 and told["suite.balanced.saca_no_memory.source.arbiter"] > 0
    assert re.fullmatch(r"4 cases \([0-9a-f]{16}\)", told["meta.memory"]) and "--memory m.sqlite" in told["meta.command"]
    page = (tmp_path / "a.html").read_text()
    assert "Where the decisions of SACA without memory came from" in page and "where memory is at least 70 % sure" in page

    assert saca("suite", "balanced", *few, "--threads", 2, "--output", "b.h5", cwd=tmp_path).returncode == SUCCESS
    journal = tmp_path / "a.h5.journal"
    assert journal.read_text() == (tmp_path / "b.h5.journal").read_text()
    # What was half done is gone on with, and ends the same.
    (tmp_path / "c.h5.journal").write_text("".join(journal.read_text().splitlines(keepends=True)[:3]))
    again = figures(saca("suite", "balanced", *few, "--threads", 2, "--output", "c.h5", cwd=tmp_path))
    assert (tmp_path / "c.h5.journal").read_text() == journal.read_text()
    assert {k: v for k, v in again.items() if "per_s" not in k and "threads" not in k} == {
        k: v for k, v in told.items() if "per_s" not in k and "threads" not in k}
    # Another memory is other work.
    saca("run", "showcase_1", "--pace", "lockstep", "--llm", "off", "--danger", "off", "--memory", "m.sqlite", cwd=tmp_path)
    assert "5 cases" in one_error(saca("suite", "balanced", *few, "--output", "a.h5", cwd=tmp_path), BAD_INPUT)


def test_an_encounter_with_memory_is_replayed_without_learning(taught, tmp_path):
    memory = pathlib.Path(shutil.copy(taught, tmp_path))
    before = memory.read_bytes()
    told = figures(saca("suite", "balanced", "--memory", "m.sqlite", "--methods", "saca", "--count", 4, "--json", "--output", "s.h5", cwd=tmp_path))
    assert told["suite.balanced.saca.forecasts"] > 0
    for number in range(4):
        run = json.loads((tmp_path / "s.h5.journal").read_text().splitlines()[1 + number])["risk"]["runs"][0]
        words = saca("suite", "balanced", "--memory", "m.sqlite", "--replay", number, cwd=tmp_path).stdout.split()
        assert "--no-learning" in words
        record = json.loads(saca(*words[1:], "--danger", "off", "--json", cwd=tmp_path).stdout)
        assert record["decision"]["policy"] == run[1][0] and record["decision"]["source"] == run[2]
        assert record["result"]["harm"] == pytest.approx(run[5], abs=1e-9)
    assert memory.read_bytes() == before


def asked(server, *arguments):
    return ("suite", "balanced", "--llm", f"some-model@http://127.0.0.1:{server.server_address[1]}/v1", "--methods", "saca,saca_no_model,aeb",
            "--count", 3, "--no-twins", "--json", *arguments)


def test_a_model_is_asked_in_suites(server, tmp_path):
    server.conclusion = "Response to user: 1"
    told = figures(saca(*asked(server, "--threads", 1, "--output", "a.h5"), cwd=tmp_path))
    place = "suite.balanced.saca."
    assert told[place + "model_asked"] == told[place + "model_answered"] > 0 == told["suite.balanced.saca_no_model.model_asked"]
    assert "some-model" in told["meta.model"] and "--llm some-model@" in told["meta.command"]
    assert sum(value for key, value in told.items() if key.startswith(place + "source.")) == sum(
        value for key, value in told.items() if key.startswith(place + "reason.")) <= 3
    assert saca(*asked(server, "--threads", 2, "--output", "b.h5"), cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "a.h5.journal").read_text() == (tmp_path / "b.h5.journal").read_text()


def test_tables_ask_two_models_and_time_their_replies(server, tmp_path):
    server.conclusion = "Response to user: 1"
    address = f"@http://127.0.0.1:{server.server_address[1]}/v1"
    told = figures(saca("tables", "--table", 3, "--count", 1, "--llm", "taught" + address, "--untuned", "base" + address,
                        "--methods", "saca,saca_unaware,saca_no_model,saca_paper_untuned,aeb", "--json", cwd=tmp_path))
    assert "taught" in told["meta.model"] and "base" in told["meta.untuned"] and "--untuned base@" in told["meta.command"]
    for key in ("model", "untuned"):
        place = f"tables.4.3.{key}."
        assert told[place + "asked"] == told[place + "done"] == told[place + "ended"] == told[place + "in_time"] >= 10 == told[place + "seconds.n"]
        assert 0.0 < told[place + "least_seconds"] <= told[place + "seconds"] < 4.2
    # Ten draws of one condition, each answered in time.
    assert told["tables.3.saca.collision_loss.in_time.n"] == told["tables.3.saca_paper_untuned.collision_loss.in_time.n"] == 10
    assert "tables.3.saca_no_model.collision_loss.in_time" not in told
    assert {one["model"] for one in server.asked} == {"taught", "base"}
    asked = [message["content"] for one in server.asked for message in one["messages"] if message["role"] == "user"]
    assert any(", risk " in text for text in asked) and any(", risk " not in text for text in asked), "who is unaware knows no risks"
    page = (tmp_path / "runs/tables/index.html").read_text()
    assert "Table IV: replies" in page and "without fine-tuning" in page
    # A method that asks another model is refused where there is none.
    assert "--untuned MODEL" in saca("suite", "table_3", "--methods", "saca_untuned", cwd=tmp_path).stderr


def test_a_suite_whose_model_dies_stops_and_goes_on_when_it_is_back(server, tmp_path):
    whole = figures(saca(*asked(server, "--threads", 1, "--output", "a.h5"), cwd=tmp_path))
    server.asked.clear()
    server.refuses_after = 3
    journal = tmp_path / "b.h5.journal"
    message = one_error(saca(*asked(server, "--threads", 1, "--output", "b.h5"), cwd=tmp_path), BAD_INPUT)
    assert "--llm: http" in message and "goes on there" in message
    assert len(journal.read_text().splitlines()) < 4  # a row without its model is not kept
    server.refuses_after = None
    again = figures(saca(*asked(server, "--threads", 1, "--output", "b.h5"), cwd=tmp_path))
    assert journal.read_text() == (tmp_path / "a.h5.journal").read_text()
    assert again["suite.balanced.saca.harm"] == whole["suite.balanced.saca.harm"]


def test_a_suite_is_interrupted_while_its_model_is_silent(server, tmp_path):
    told = interrupted_while_silent(server, *asked(server, "--output", "s.h5"), cwd=tmp_path)
    assert "goes on where this one stopped" in told
    assert len((tmp_path / "s.h5.journal").read_text().splitlines()) == 1


def test_the_ladder_has_a_rung_for_what_memory_holds(taught, tmp_path):
    shutil.copy(taught, tmp_path)
    told = figures(saca("ladder", "balanced", "--memory", "m.sqlite", "--count", 2, "--json", "--output", "l.json", cwd=tmp_path))
    assert told["ladder.balanced.saca.step_from.aeb"] == pytest.approx(told["ladder.balanced.saca"] - told["ladder.balanced.aeb"], abs=1e-9)
    assert told["ladder.balanced.saca.forecasts"] > 0
