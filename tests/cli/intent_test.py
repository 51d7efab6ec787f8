"""`saca intent examples`, `show` and `eval`."""
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca
from traffic_test import road


def drivers():
    """Ids 7 and 108 are of two groups. One goes on, one changes lanes within 4 s, one brakes with 4 m/s2 for 2 s."""
    steady = [(150 + 1.5 * k, 0.0, 15.0) for k in range(120)]
    changing = [(40 + 1.5 * k, 3.5 * min(1.0, max(0.0, (k - 30) / 40)), 15.0) for k in range(120)]
    braking, x, v = [], 60.0, 15.0
    for k in range(120):
        braking.append((x, 3.5, v))
        x, v = x + 0.1 * v, v - (0.4 if 40 <= k < 60 else 0.0)
    return road([(7, steady), (108, changing), (209, braking)])


@pytest.fixture(scope="module")
def sequences(tmp_path_factory):
    folder = tmp_path_factory.mktemp("intent")
    (folder / "one.xml").write_text(drivers())
    assert saca("traffic", "pack", "commonroad", "one.xml", "-o", "set.h5", cwd=folder).returncode == SUCCESS
    made = saca("intent", "examples", "set.h5", "--simulated", "20", "--parts", "2", "-o", "sequences.h5", cwd=folder)
    assert made.returncode == SUCCESS, made.stderr
    rows = {line.split()[0]: line for line in made.stdout.splitlines()[1:]}
    assert set(rows) == {"part-0", "part-1", "simulated", "test"}
    frames = [sum(int(rows[part].split("|")[1].split(";")[0].split()[k]) for part in ("part-0", "part-1")) for k in range(6)]
    assert frames[1] > 20 and frames[3] > 10  # 4 s aside, 2 s of braking, less what is in doubt
    assert frames[2] == frames[4] == frames[5] == 0
    return folder / "sequences.h5"


def test_samples_are_drawn_with_labels_and_beliefs(sequences, tmp_path):
    shown = saca("intent", "show", sequences, "--split", "simulated", "--samples", "4", "-o", "page.html", cwd=tmp_path)
    assert shown.returncode == SUCCESS, shown.stderr
    page = (tmp_path / "page.html").read_text()
    assert page.count("<figure") == 4 or page.count("<svg") >= 4
    shown = saca("intent", "show", sequences, "-o", "one.svg", cwd=tmp_path)
    assert shown.returncode == SUCCESS and (tmp_path / "one.svg").read_text().startswith("<svg")
    assert "want sequences that fit" in one_error(saca("intent", "show", sequences, "--name", "nobody", "-o", "x.html",
                                                       cwd=tmp_path), BAD_INPUT)


def test_the_shipped_models_are_scored(sequences, tmp_path):
    told = json.loads(saca("intent", "eval", sequences, "--json", cwd=tmp_path).stdout)
    assert told["schema"] == "saca.intent_eval/1"
    recorded = told["comparisons"][0]
    assert [row["method"] for row in recorded["methods"]] == ["LSTM-CRF", "LSTM-CRF, nothing shared", "CRF by hand",
                                                            "causal rule", "constant motion"]
    for row in recorded["methods"]:
        for head in row["heads"]:
            counted = sum(sum(line) for line in head["confusion"])
            assert counted == sum(one["frames"] for one in head["classes"].values()) > 100
    constant = recorded["methods"][4]["heads"][0]["classes"]
    assert constant["M"]["recall"] == 1.0 and constant["FB"]["recall"] == 0.0
    ahead = {(one["vehicles"], one["foresight"], one["ahead_s"]): one for one in told["displacements"]}
    assert ahead["all", "constant velocity", 1]["frames"] > 10
    acts = recorded["methods"][0]["acts"]["FB"]
    counted = sum(one["frames"] for one in acts["recall_by_age"])
    assert counted == recorded["methods"][0]["heads"][0]["classes"]["FB"]["frames"] and acts["found"] <= acts["acts"]
    text = saca("intent", "eval", sequences, "--svg", "confusion.svg", cwd=tmp_path)
    assert (tmp_path / "confusion.svg").read_text().startswith("<svg")
    assert text.returncode == SUCCESS and "macro F1 now" in text.stdout and "constant velocity" in text.stdout


def test_two_trainings_are_compared_as_they_are(sequences, tmp_path):
    told = json.loads(saca("intent", "eval", sequences, "--other-models", ROOT / "models/intent", "--json", cwd=tmp_path).stdout)
    other = next(one for one in told["comparisons"][0]["methods"] if one["method"] == "LSTM-CRF of another training")
    for head in other["heads"]:  # the same weights
        assert set(head["macro_f1_ours_less_this"].values()) <= {0.0, None}
        assert set(head["log_loss_ours_less_this"].values()) <= {0.0, None}


def test_what_cannot_be_used_is_refused(sequences, tmp_path):
    (tmp_path / "empty").mkdir()
    assert "want a folder with models" in one_error(
        saca("intent", "eval", sequences, "--models", tmp_path / "empty", cwd=tmp_path), BAD_INPUT)
    (tmp_path / "damaged.h5").write_bytes(sequences.read_bytes()[:2000])
    assert "damaged.h5" in one_error(saca("intent", "eval", "damaged.h5", cwd=tmp_path), BAD_INPUT)
    assert "set.h5" in one_error(saca("intent", "examples", "set.h5", "-o", "x.h5", cwd=tmp_path), BAD_INPUT)
    assert saca("intent", "examples", sequences, "--parts", "1", "-o", "x.h5", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
