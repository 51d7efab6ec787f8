"""`saca reason`: what the language model is first asked in an encounter, and what it says."""
import json
import os
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: F401, a fixture
from program import BAD_INPUT, ROOT, SUCCESS, TOO_SLOW, WRONG_COMMAND_LINE, one_error, saca


def key_of(prompt):
    """FNV-1a, 64 bits, as its authors publish it."""
    key = 0xCBF29CE484222325
    for byte in prompt.encode():
        key = (key ^ byte) * 0x100000001B3 % 2**64
    return f"{key:016x}"


@pytest.fixture(scope="module")
def replies(tmp_path_factory):
    return replies_to("intersection_t1", tmp_path_factory.mktemp("reason"))


def replies_to(scenario, folder):
    """Replies to the first questions of a scenario, one for each forecast, written by hand for the prompts that are asked."""
    nobody = folder / "nobody.json"
    nobody.write_text(json.dumps({"schema": "saca.replies/1", "model": "by hand", "replies": {}}))
    run = saca("reason", scenario, "--llm", f"replay:{nobody}", cwd=folder)
    assert run.returncode == BAD_INPUT  # it knows no prompt; the question is told all the same
    prompts = [forecast.split("---\n", 1)[1].split("\n--- Forecast", 1)[0].rstrip("\n") + "\n" for forecast in run.stdout.split("trigger at")[1:]]
    assert prompts and all(one.startswith("ego: ") and "Least harm:" in one for one in prompts)
    answers = [{"after_ns": 50_000_000, "kind": "first", "probability": [0.25, 0.75, 0, 0, 0, 0, 0, 0]},
               {"after_ns": 120_000_000, "kind": "ended", "probability": [0.875, 0.125, 0, 0, 0, 0, 0, 0]}]
    reply = {"reasoning": "Scenario Analysis\n1. AEB is clear.\n2. Grip 0.90, speed 14.0 m/s, and 99.5 m.\nResponse to user: 0",
             "prompt_tokens": 400, "reply_tokens": 30, "answers": answers}
    file = folder / "replies.json"
    file.write_text(json.dumps({"schema": "saca.replies/1", "model": "by hand",
                                "replies": {key_of(prompt): {"prompt": prompt, **reply} for prompt in prompts}}))
    return file


def test_it_is_told_with_its_answers_over_time(replies, tmp_path):
    for more in ((), ("--stream",)):
        run = saca("reason", "intersection_t1", "--llm", f"replay:{replies}", *more, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
        assert run.stdout.count("Scenario Analysis") == run.stdout.count("trigger at") >= 1
        assert "50 ms   first    25 %    75 %" in run.stdout and "120 ms   ended    88 %" in run.stdout
        assert "Truth: 1 of 2 statements" in run.stdout and "99.5 m stands nowhere" in run.stdout
        assert "Choice: 0 AEB; rollout check passed" in run.stdout


def test_for_programs(replies, tmp_path):
    told = json.loads(saca("reason", "intersection_t1", "--llm", f"replay:{replies}", "--json", cwd=tmp_path).stdout)
    assert told["schema"] == "saca.reason/1" and "0 AEB" in told["system"]
    forecast = told["forecasts"][0]  # the likeliest
    assert [one["policy"] for one in forecast["answers"]] == [1, 0]
    assert [round(one["after_ms"]) for one in forecast["answers"]] == [50, 120]
    assert forecast["truth"]["score"] == 0.5 and forecast["truth"]["checked"] == 2
    assert [one["load_bearing"] for one in forecast["truth"]["false"]] == [False]
    assert forecast["check"]["passed"] is True and 0.0 < forecast["probability"] <= 1.0


def test_reasons_by_the_figures_are_those_of_the_prompt(tmp_path):
    told = json.loads(saca("reason", "lead_brakes_follower", "--llm", f"replay:{replies_to('lead_brakes_follower', tmp_path)}", "--json", cwd=tmp_path).stdout)
    (forecast,) = told["forecasts"]
    assert forecast["explanation"]["from"] == "facts"
    harms = re.findall(r"harm \d+\.\d{1,3}(?!\d)", forecast["explanation"]["text"])
    assert harms and all(harm in forecast["prompt"] for harm in harms)


def test_nothing_is_asked_where_nothing_threatens(replies, tmp_path):
    run = saca("reason", "lead_drives_on_follower", "--llm", f"replay:{replies}", cwd=tmp_path)
    assert run.returncode == SUCCESS and "nothing to ask" in run.stdout
    told = json.loads(saca("reason", "lead_drives_on_follower", "--llm", f"replay:{replies}", "--json", cwd=tmp_path).stdout)
    assert told["forecasts"] == []


def test_what_cannot_be_asked_is_refused(replies, tmp_path):
    off = saca("reason", "intersection_t1", "--llm", "off", cwd=tmp_path)
    assert "want a language model to ask, got `off`" in one_error(off, BAD_INPUT)
    assert saca("reason", "intersection_t1", "--deadline-ms", 0, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    late = saca("reason", "intersection_t1", "--llm", f"replay:{replies}", "--deadline-ms", 20, cwd=tmp_path)
    assert "replay" in one_error(late, TOO_SLOW)


def test_a_server_can_be_asked(server, tmp_path):
    url = f"some-model@http://127.0.0.1:{server.server_address[1]}/v1"
    run = saca("reason", "intersection_t1", "--llm", url, cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert "Choice: 6 T-D-R" in run.stdout and "Truth: 1 of 1 statements" in run.stdout
    forecasts = run.stdout.count("trigger at")
    assert forecasts >= 1 and [asked["temperature"] for asked in server.asked[:forecasts]] == [0] * forecasts
    # What holds no reasons for its choice is tried again, by chance.
    again = server.asked[forecasts:]
    assert [(asked["seed"], asked["temperature"]) for asked in again] == [(1, 0.7), (2, 0.7)] * forecasts
    for asked in server.asked:
        assert asked["model"] == "some-model" and "Least harm:" in asked["messages"][-1]["content"]


def test_its_key_is_told_to_nobody(server, tmp_path):
    server.refuses = True
    url = f"some-model@http://127.0.0.1:{server.server_address[1]}/v1"
    run = saca("reason", "intersection_t1", "--llm", url, cwd=tmp_path, env=os.environ | {"SACA_LLM_KEY": "sk-very-secret"})
    assert "401" in one_error(run, BAD_INPUT) and "very-secret" not in run.stderr + run.stdout
    run = saca("reason", "intersection_t1", "--llm", "m@http://example.com/v1", cwd=tmp_path, env=os.environ | {"SACA_LLM_KEY": "sk-very-secret"})
    assert "https" in one_error(run, BAD_INPUT) and "very-secret" not in run.stderr
