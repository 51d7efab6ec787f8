"""`--llm MODEL@URL` with a server that others wrote: llama-server, of `tools/model/setup.sh server`."""
import json
import os
import pathlib
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, ROOT, SUCCESS, TOO_SLOW, one_error, saca

KEY = "sk-of-this-test"
# What an untrained model would not keep to by itself: our form of a reply.
GRAMMAR = r'root ::= "Scenario Analysis\n1. " [a-zA-Z0-9 .,%/]{1,60} "\nResponse to user: " [0-7]'


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    program = ROOT / "third_party/llama-server/llama-server"
    if not program.exists():
        pytest.skip("there is no llama-server: `tools/model/setup.sh server` builds it, in some minutes; `make soak` does")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path_factory.mktemp("server") / "log"
    with open(log, "w") as out:
        running = subprocess.Popen(
            [program, "--model", ROOT / "third_party/models/saca-SmolLM2-135M.Q8_0.gguf", "--host", "127.0.0.1", "--port", str(port),
             "--ctx-size", "4096", "--parallel", "2", "--threads", "1", "--api-key", KEY, "--grammar", GRAMMAR],
            stdout=out, stderr=out, env=os.environ | {"GOMP_SPINCOUNT": "1000"})  # other tests want the cores too
    url = f"http://127.0.0.1:{port}"
    for _ in range(15_000):
        assert running.poll() is None, log.read_text()[-2000:]
        try:
            urllib.request.urlopen(url + "/health", timeout=5).read()
            break
        except (urllib.error.URLError, OSError):
            time.sleep(0.1)
    yield url + "/v1"
    running.terminate()
    running.wait(1500)


def ask(url, *more, folder, key=KEY):
    return saca("reason", "intersection_t1", "--llm", f"smollm2@{url}", *more, cwd=folder, env=os.environ | {"SACA_LLM_KEY": key})


def test_it_answers_in_our_form(server, tmp_path):
    run = ask(server, "--deadline-ms", 100_000, "--json", folder=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    told = json.loads(run.stdout)
    (forecast,) = told["forecasts"]
    assert forecast["reasoning"].startswith("Scenario Analysis\n1. ")
    stated = int(forecast["reasoning"].rsplit("Response to user: ", 1)[1][0])
    (answer,) = forecast["answers"]
    assert answer["kind"] == "ended" and answer["policy"] == stated and answer["probability"][stated] == 1.0
    assert 0 < answer["after_ms"] < 100_000
    # As the server counts them: system part and scene, both by the tokeniser that our bound is made for.
    assert 450 < forecast["prompt_tokens"] < 1000 and 10 < forecast["reply_tokens"] < 100


def test_no_time_is_no_answer(server, tmp_path):
    run = ask(server, "--deadline-ms", 100, folder=tmp_path)
    assert "deadline" in one_error(run, TOO_SLOW)


def test_a_wrong_key_is_told(server, tmp_path):
    run = ask(server, folder=tmp_path, key="sk-another")
    assert "401" in one_error(run, BAD_INPUT) and "sk-another" not in run.stderr
