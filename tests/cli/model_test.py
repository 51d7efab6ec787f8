"""`saca model bench|score`: how fast and how well a model answers. The model here is a server that always says 6."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: F401, a fixture
from program import BAD_INPUT, SUCCESS, WRONG_COMMAND_LINE, interrupted_while_silent, one_error, saca


def name_of(server):
    return f"some-model@http://127.0.0.1:{server.server_address[1]}/v1"


def test_bench_measures_any_model(server, tmp_path):
    run = saca("model", "bench", "--llm", name_of(server), "--runs", 2, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert len(server.asked) == 2 * (1 + 3)
    assert told["reason.first_answer_s.n"] == 2 and 0 < told["reason.first_answer_s.p50"] <= told["reason.full_answer_s.max"]
    assert told["reason.deadline_misses"] == 0 and told["reason.forced_share"] == 0
    assert "reason.load_s" not in told  # nobody knows it of a server
    assert "some-model" in told["meta.model"]


def test_bench_of_a_slow_model_has_figures_too(server, tmp_path):
    server.pause = 4.5  # more than the 4.2 s that there are for three forecasts
    run = saca("model", "bench", "--llm", name_of(server), "--runs", 1, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["reason.full_answer_s.p50"] > 4.5 and told["reason.deadline_misses"] == 1
    assert "reason.three_previews_s.p50" not in told


def test_score_is_of_what_was_carried_out_and_goes_on(server, tmp_path):
    def score(count, *more):
        run = saca("model", "score", "--llm", name_of(server), "--count", count, "--json", *more, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
        return json.loads(run.stdout)

    told, asked = score(2), len(server.asked)
    assert told["schema"] == "saca.model_score/2" and told["encounters"] == 2 and "some-model" in told["model"]
    with_facts = {"Least harm:" in question["messages"][-1]["content"] for question in server.asked}
    assert with_facts == {False, True}
    choices = told["choices"]
    assert abs(choices["best_in_hindsight"]["regret"]["mean"]) < 0.003
    # A server has no answer before its text; what is not checked is carried out as it was said.
    assert choices["facts_at_once"]["harm"] == choices["facts_reasoned"]["harm"]
    assert choices["facts_checked"]["harm"]["mean"] >= choices["best_in_hindsight"]["harm"]["mean"] - 0.003
    assert told["with_facts"]["asked"] > 0 and told["with_facts"]["ended_share"] == 1.0
    assert told["with_facts"]["statements_checked"] > 0

    assert score(2) == told and len(server.asked) == asked  # remembered
    assert score(3)["encounters"] == 3 and len(server.asked) > asked
    lines = (tmp_path / "runs/model-score-balanced-calibration.journal").read_text().splitlines()
    assert len(lines) == 1 + 3
    score(3, "--threads", 1, "--journal", "one.journal")
    assert (tmp_path / "one.journal").read_text().splitlines() == lines

    spoilt = tmp_path / "spoilt.journal"
    spoilt.write_text("\n".join([lines[0], "nonsense"]) + "\n")
    run = saca("model", "score", "--llm", name_of(server), "--count", 2, "--journal", spoilt, cwd=tmp_path)
    assert "spoilt.journal: line 2" in one_error(run, BAD_INPUT)


def test_bench_of_a_model_that_does_not_answer_is_no_bench(server, tmp_path):
    server.conclusion = "I cannot say."
    run = saca("model", "bench", "--llm", name_of(server), "--runs", 2, cwd=tmp_path)
    assert "got Scenario Analysis" in one_error(run, BAD_INPUT)


def test_replies_without_an_answer_leave_braking(server, tmp_path):
    server.conclusion = "I cannot say."
    run = saca("model", "score", "--llm", name_of(server), "--count", 2, "--json", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    assert told["with_facts"]["answered_share"] == 0 and "temperature" not in told
    assert told["choices"]["facts_reasoned"]["harm"] == told["choices"]["facts_checked"]["harm"] == told["choices"]["always_aeb"]["harm"]


def test_scoring_is_interrupted_while_the_model_is_silent(server, tmp_path):
    told = interrupted_while_silent(server, "model", "score", "--llm", name_of(server), "--count", 2, cwd=tmp_path)
    assert "goes on where this one stopped" in told


def test_what_cannot_be_scored_is_refused(tmp_path):
    assert saca("model", "score", "--count", 1, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    assert "want a language model to ask, got `off`" in one_error(saca("model", "score", "--llm", "off", "--count", 2, cwd=tmp_path), BAD_INPUT)
    assert "want a language model to ask, got `off`" in one_error(saca("model", "bench", "--llm", "off", cwd=tmp_path), BAD_INPUT)
