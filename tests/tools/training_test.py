"""Training of the language model: what it learns from, and that it learns."""
import gzip
import hashlib
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
from xml.etree import ElementTree

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRAINING = ROOT / "training"
PYTHON = ROOT / "build/training/bin/python"
sys.path.insert(0, str(TRAINING))
import curve  # noqa: E402
import examples  # noqa: E402
import kept  # noqa: E402

needs_environment = pytest.mark.skipif(not PYTHON.exists(), reason="PyTorch is not installed (training/run.sh setup)")
HEADER = {"schema": "saca.reply_examples/1", "examples": 1}
EXAMPLE = {"record": "fars_1", "family": "rear_end", "twin": False, "prompt": "0 AEB: clear", "choice": 3, "admissible": [3],
           "reply": "Scenario Analysis\n1. So ES-B-L.\nResponse to user: 3", "forecast": [0.1] * 8, "known": [None] * 8}
END = -1


def letters(text):
    """A tokeniser whose tokens are letters: a digit is a token of its own."""
    return [ord(letter) for letter in text]


def write(path, *documents):
    path.write_text("".join(json.dumps(one) + "\n" for one in documents))
    return path


def sequence(seed=1):
    one = examples.read_set_line(json.dumps(EXAMPLE), "place")
    return examples.sequence_of(one, letters, END, 5.0, random.Random(seed))


def branch(made, number):
    return [i for i, of in enumerate(made.branch) if of == number]


def test_sets_are_read_back(tmp_path):
    (one,) = examples.read_set(write(tmp_path / "train.jsonl", HEADER, EXAMPLE))
    assert one.record == "fars_1" and one.choice == 3 and one.known == (None,) * 8


@pytest.mark.parametrize("documents, message", [
    ((), "train.jsonl:1: want a header"),
    (({"schema": "saca.cases/1"}, EXAMPLE), "train.jsonl:1: want a header"),
    (([1], EXAMPLE), "train.jsonl:1: want a header"),
    ((dict(HEADER, examples=2), EXAMPLE), "want 2 examples, got 1"),
    ((HEADER, {key: value for key, value in EXAMPLE.items() if key != "known"}), "train.jsonl:2: want the key 'known'"),
    ((HEADER, dict(EXAMPLE, choice=4)), "train.jsonl:2: want a reply that ends with its choice"),
    ((HEADER, dict(EXAMPLE, choice="x")), "train.jsonl:2: want an example"),
    ((HEADER, dict(EXAMPLE, reply=5)), "train.jsonl:2: want a text as reply, got 5"),
    ((HEADER, dict(EXAMPLE, prompt=None)), "train.jsonl:2: want a text as prompt, got None"),
    ((HEADER, dict(EXAMPLE, admissible=[9])), "train.jsonl:2: want policies, 0 to 7, as admissible, got .9"),
    ((HEADER, dict(EXAMPLE, admissible=["3"])), "train.jsonl:2: want policies, 0 to 7, as admissible"),
    ((HEADER, dict(EXAMPLE, known=[0.1, 0.2])), "train.jsonl:2: want eight numbers or null as known, got .0.1, 0.2"),
    ((HEADER, dict(EXAMPLE, forecast=["x"] * 8)), "train.jsonl:2: want eight numbers or null as forecast"),
])
def test_bad_sets_are_refused(tmp_path, documents, message):
    with pytest.raises(examples.Problem, match=message.replace("(", ".")):
        examples.read_set(write(tmp_path / "train.jsonl", *documents))
    with pytest.raises(examples.Problem, match="none.jsonl: cannot read"):
        examples.read_set(tmp_path / "none.jsonl")


def test_what_is_no_text_is_refused(tmp_path):
    (tmp_path / "system.txt").write_bytes(b"\xff")
    for read in (examples.read_text, examples.read_set):
        with pytest.raises(examples.Problem, match="system.txt: want UTF-8"):
            read(tmp_path / "system.txt")
    with pytest.raises(examples.Problem, match="none.txt: cannot read: No such file"):
        examples.read_text(tmp_path / "none.txt")


def test_files_are_told_apart_by_the_last_parts_of_their_paths():
    contents = {"runs/training/sets/train.jsonl": "a", "runs/training/cues/train.jsonl": "b", "base.gguf": "c"}
    assert kept.by_last_parts(contents) == {"sets/train.jsonl": "a", "cues/train.jsonl": "b", "base.gguf": "c"}
    alike = {"one/cues/train.jsonl": "a", "two/cues/train.jsonl": "b", "/far/two/base.gguf": "c"}
    assert kept.by_last_parts(alike) == {"one/cues/train.jsonl": "a", "two/cues/train.jsonl": "b", "far/two/base.gguf": "c"}


def kept_of(tmp_path):
    """What a training with one folder of sets tells of itself."""
    return {"steps": "400", **kept.contents([tmp_path / "sets"], [tmp_path / "base.gguf"])}


def test_a_kept_training_goes_on_with_the_same_contents_only(tmp_path):
    (tmp_path / "sets").mkdir()
    for name in ("sets/system.txt", "sets/train.jsonl", "sets/calibration.jsonl", "base.gguf"):
        (tmp_path / name).write_text("first")
    before = kept_of(tmp_path)
    kept.refuse_other("kept.pt", before, kept_of(tmp_path))
    for name in ("sets/system.txt", "sets/train.jsonl", "sets/calibration.jsonl", "base.gguf"):
        (tmp_path / name).write_text("second")
        with pytest.raises(examples.Problem) as problem:
            kept.refuse_other("kept.pt", before, kept_of(tmp_path))
        assert str(problem.value) == (f"kept.pt: is of other settings or of files with other contents ({tmp_path / name}); "
                                      "choose another folder, or remove it to begin anew")
        (tmp_path / name).write_text("first")
    with pytest.raises(examples.Problem, match="other contents .steps.;"):
        kept.refuse_other("kept.pt", dict(before, steps="20"), kept_of(tmp_path))
    with pytest.raises(examples.Problem, match="other contents .rank.;"):
        kept.refuse_other("kept.pt", dict(before, rank="8"), kept_of(tmp_path))


def test_a_training_kept_before_contents_were_is_refused(tmp_path):
    (tmp_path / "sets").mkdir()
    for name in ("sets/system.txt", "sets/train.jsonl", "sets/calibration.jsonl", "base.gguf"):
        (tmp_path / name).write_text("first")
    with pytest.raises(examples.Problem, match="base.gguf, .*system.txt, .*train.jsonl.; choose another folder"):
        kept.refuse_other("kept.pt", {"steps": "400"}, kept_of(tmp_path))


def test_each_branch_is_the_reply_that_the_engine_asks_for():
    made = sequence()
    text = lambda number: "".join(chr(made.tokens[i]) for i in branch(made, number) if made.tokens[i] != END)
    assert text(0) == "0 AEB: clear<|im_end|>\n<|im_start|>assistant\n"
    assert text(1) == EXAMPLE["reply"] and made.tokens[branch(made, 1)[-1]] == END
    assert text(2) == text(3) == " Response to user: 3"


def test_only_replies_are_learnt_and_the_answer_weighs_more():
    made = sequence()
    assert all(made.weight[i] == 0.0 for i in branch(made, 0))
    reasoned = [made.weight[i] for i in branch(made, 1)]
    assert reasoned == [1.0] * (len(reasoned) - 2) + [5.0, 1.0]
    for number in (2, 3):  # nobody has to learn the question
        assert [made.weight[i] for i in branch(made, number)] == [0.0] * (len(branch(made, number)) - 1) + [5.0]


def test_where_the_choice_is_named_weighs_as_much_as_the_answer():
    reply = "Scenario Analysis\n1. AEB: car1.\n2. So ES-B-L: as good as AEB.\nResponse to user: 3"
    one = examples.read_set_line(json.dumps(dict(EXAMPLE, reply=reply)), "place")
    made = examples.sequence_of(one, letters, END, 5.0, random.Random(1))
    heavy = [i for i in branch(made, 1) if made.weight[i] == 5.0]
    assert "".join(chr(made.tokens[i]) for i in heavy) == " So ES-B-L3" and len({made.weight[i] for i in branch(made, 1)}) == 2


def test_tokens_are_predicted_from_those_before_them():
    for seed in range(20):
        made = sequence(seed)
        prompt = branch(made, 0)
        for number in (1, 2, 3):
            own = branch(made, number)
            assert [made.source[i] for i in own[1:]] == own[:-1]
        assert made.source[branch(made, 1)[0]] == made.source[branch(made, 2)[0]] == prompt[-1]
        assert 1 <= made.cut < len(branch(made, 1))
        before = len(prompt) + made.cut - 1  # the reasoning's last token that the cut branch sees
        assert made.branch[before] == 1 and made.source[branch(made, 3)[0]] == before
        assert made.position[branch(made, 3)[0]] == made.position[before] + 1
        assert [made.position[i] for i in branch(made, 2)] == list(range(len(prompt), len(prompt) + len(branch(made, 2))))


def test_the_answer_at_once_may_be_shared_by_harm():
    told = dict(EXAMPLE, admissible=[0, 3], known=[0.02, 0.0, None, 0.01, 0.5, 0.5, 0.5, 1.0])
    one = examples.read_set_line(json.dumps(told), "place")
    assert examples.shares_of_answers(one, 0.0) == [0, 0, 0, 1, 0, 0, 0, 0]
    better = 1 / (1 + math.exp(-1))  # 0.01 less harm at a scale of 0.01; 1, which harms nobody, is not admissible
    assert examples.shares_of_answers(one, 0.01) == pytest.approx([1 - better, 0, 0, better, 0, 0, 0, 0])
    nothing = examples.read_set_line(json.dumps(dict(told, admissible=[0, 7], choice=7, reply=told["reply"].replace("user: 3", "user: 7"))), "place")
    assert examples.shares_of_answers(nothing, 0.01) == [0, 0, 0, 0, 0, 0, 0, 1]
    unknown = examples.read_set_line(json.dumps(dict(told, admissible=[2, 3])), "place")
    assert examples.shares_of_answers(unknown, 0.01) == [0, 0, 0, 1, 0, 0, 0, 0]
    made = examples.sequence_of(one, letters, END, 5.0, random.Random(1), 0.01)
    assert made.shares[3] == pytest.approx(better) and made.branch[made.at_once] == 2 and chr(made.tokens[made.at_once]) == "3"


def test_a_tokeniser_that_splits_answers_is_refused():
    one = examples.read_set_line(json.dumps(EXAMPLE), "place")
    with pytest.raises(examples.Problem, match="a token of its own"):
        examples.sequence_of(one, lambda text: [text], END, 5.0, random.Random(1))


def test_batches_hold_every_example_once_of_about_one_length():
    lengths = [random.Random(i).randrange(200, 500) for i in range(101)]
    made = examples.batches_of(lengths, 4, 0, 1)
    assert sorted(i for one in made for i in one) == list(range(101)) and max(map(len, made)) == 4
    assert made == examples.batches_of(lengths, 4, 0, 1) != examples.batches_of(lengths, 4, 1, 1)
    spread = lambda batches: sum(max(lengths[i] for i in one) - min(lengths[i] for i in one) for one in batches)
    assert spread(made) < 0.3 * spread([list(range(i, min(i + 4, 101))) for i in range(0, 101, 4)])


def in_environment(code, *arguments):
    run = subprocess.run([PYTHON, "-c", code, *map(str, arguments)], cwd=TRAINING, capture_output=True, text=True,
                         env={"PYTHONDONTWRITEBYTECODE": "1", "HF_HUB_OFFLINE": "1", "OMP_NUM_THREADS": "1"})
    assert run.returncode == 0, run.stderr[-2000:]
    return json.loads(run.stdout.splitlines()[-1])


# A tiny model with random weights: what a branch's tokens see, and that nothing else changes what it says.
TINY = """
import dataclasses, json, random, sys, torch, transformers
import batch as batches, examples, fine_tune
torch.manual_seed(1)
config = transformers.LlamaConfig(vocab_size=300, hidden_size=64, intermediate_size=96, num_hidden_layers=2, num_attention_heads=4,
                                  num_key_value_heads=2, max_position_embeddings=512, initializer_range=0.2)
given = fine_tune.options(["sets", "base", "out", "--rank", "4", "--alpha", "32"])
model = fine_tune.with_adapter(transformers.LlamaForCausalLM(config), given)
model.eval()
letters = lambda text: [ord(letter) % 299 for letter in text]
def example(prompt, reply, choice):
    return examples.Example("r", "f", False, prompt, f"{reply}\\nResponse to user: {choice}", choice, (choice,), (0.0,) * 8, (0.0,) * 8)
system = letters("rules")
digits = [letters(str(answer))[0] for answer in range(8)]
"""


@needs_environment
def test_branches_say_what_they_would_say_alone():
    assert in_environment(TINY + """
one, two = example("a scene", "so it is", 3), example("another scene, longer", "no", 5)
made = [examples.sequence_of(each, letters, 299, 5.0, random.Random(2)) for each in (one, two)]
together = batches.batch_of(made, len(system), 299)
logits = fine_tune.logits_of(model, system, together)
worst = 0.0
for k, (row, source) in enumerate(zip(together.rows.tolist(), together.sources.tolist())):
    s = made[row]
    number = s.branch[source]
    target_branch = next(s.branch[i] for i in range(len(s.tokens)) if s.source[i] == source and s.weight[i] > 0 and s.tokens[i] == together.targets[k])
    prompt = s.branch.count(0)
    if target_branch == 3:
        path = list(range(prompt + s.cut)) + [i for i in range(source + 1) if s.branch[i] == 3]
    else:
        path = list(range(prompt)) + [i for i in range(source + 1) if s.branch[i] == target_branch]
    alone = model(input_ids=torch.tensor([system + [s.tokens[i] for i in path]])).logits[0, -1]
    worst = max(worst, (alone - logits[k]).abs().max().item())
print(json.dumps({"worst": worst, "predictions": len(together.targets)}))
""")["worst"] < 1e-4


@needs_environment
def test_what_is_repeated_is_learnt():
    told = in_environment(TINY + """
trained = [p for p in model.parameters() if p.requires_grad]
optimizer = torch.optim.AdamW(trained, lr=0.01)
made = [examples.sequence_of(example(prompt, "so", choice), letters, 299, 5.0, random.Random(3)) for prompt, choice in (("left is clear", 1), ("right is clear", 2))]
both = batches.batch_of(made, len(system), 299)
losses = []
for step in range(200):
    loss = fine_tune.loss_of(model, system, both, digits)
    optimizer.zero_grad(); loss.backward(); optimizer.step()
    losses.append(loss.item())
print(json.dumps({"first": losses[0], "last": losses[-1]}))
""")
    assert told["last"] < 0.5 * told["first"]


@needs_environment
def test_a_loss_over_shares_is_the_mean_over_answers():
    told = in_environment(TINY + """
made = examples.sequence_of(example("a scene", "so", 3), letters, 299, 5.0, random.Random(3))
loss = lambda shares: fine_tune.loss_of(model, system, batches.batch_of([dataclasses.replace(made, shares=shares)], len(system), 299), digits).item()
one_hot = lambda answer: [float(k == answer) for k in range(8)]
half = [0.5 * (a + b) for a, b in zip(one_hot(3), one_hot(6))]
usual = batches.batch_of([made], len(system), 299)
plain = torch.nn.functional.cross_entropy(fine_tune.logits_of(model, system, usual), usual.targets, reduction="none")
print(json.dumps({"half": loss(half), "mean": 0.5 * (loss(one_hot(3)) + loss(one_hot(6))), "hard": loss(one_hot(3)),
                  "plain": ((plain * usual.weights).sum() / usual.weights.sum()).item()}))
""")
    assert told["half"] == pytest.approx(told["mean"], rel=1e-5) and told["hard"] == pytest.approx(told["plain"], rel=1e-5)
    assert told["half"] != pytest.approx(told["hard"], rel=1e-3)


@needs_environment
def test_the_rate_rises_and_falls():
    rates = in_environment(TINY + """
given = fine_tune.options(["sets", "base", "out", "--steps", "100", "--warm-up", "10"])
print(json.dumps([fine_tune.rate_at(step, given) for step in range(100)]))
""")
    assert rates[:10] == pytest.approx([0.1 * k for k in range(1, 11)]) and rates[10] == pytest.approx(1.0)
    assert rates[55] == pytest.approx(0.5) and rates[99] < 0.001 and rates[10:] == sorted(rates[10:], reverse=True)


# llama.cpp's own rule: of a head's rows r and r + d / 2 stand side by side.
@needs_environment
def test_an_adapter_has_llama_cpps_order_of_rows(tmp_path):
    told = in_environment(TINY + """
import adapter, gguf, numpy, pathlib, peft
(pathlib.Path(sys.argv[1]) / "base.gguf").write_bytes(b"weights")
state = {key: torch.arange(value.numel(), dtype=torch.float32).reshape(value.shape) for key, value in peft.get_peft_model_state_dict(model).items()}
path = pathlib.Path(sys.argv[1]) / "adapter.gguf"
adapter.write_adapter(path, state, config, 8, path.parent / "base.gguf", "test")
reader = gguf.GGUFReader(path)
tensors = {one.name: one.data.tolist() for one in reader.tensors}
print(json.dumps({"names": len(tensors), "q": [row[0] for row in tensors["blk.0.attn_q.weight.lora_b"]], "o": [row[0] for row in tensors["blk.1.attn_output.weight.lora_b"]],
                  "a": len(tensors["blk.0.ffn_down.weight.lora_a"]), "fields": sorted(reader.fields)}))
""", tmp_path)
    assert told["names"] == 2 * 7 * 2 and told["a"] == 4
    row = lambda head, k: 4.0 * (16 * head + k)  # 64 rows of rank 4, four heads of 16
    assert told["q"] == [row(head, k + half) for head in range(4) for k in range(8) for half in (0, 8)]
    assert told["o"] == [4.0 * k for k in range(64)]
    assert {"adapter.lora.alpha", "adapter.type", "general.type", "saca.base.sha256"} <= set(told["fields"])


@needs_environment
def test_an_adapter_comes_back_and_is_gone_on_with(tmp_path):
    told = in_environment(TINY + """
import adapter, argparse, pathlib, peft
import fine_tune
folder = pathlib.Path(sys.argv[1])
for name in ("base", "other"):
    (folder / f"{name}.gguf").write_bytes(name.encode())
state = {key: torch.randn(value.shape).half().float() for key, value in peft.get_peft_model_state_dict(model).items()}
adapter.write_adapter(folder / "adapter.gguf", state, config, 8, folder / "base.gguf", "test")
back, alpha = adapter.read_adapter(folder / "adapter.gguf", config, folder / "base.gguf")
given = argparse.Namespace(base=folder / "base.gguf", alpha=8, rank=4)
fine_tune.begin_with(model, folder / "adapter.gguf", given)
begun = peft.get_peft_model_state_dict(model)
refused = []
base = str(given.base)
torch.save({"adapter": state, "settings": {"alpha": "8", "base": base, base: fine_tune.kept.sha256_of(base)}}, folder / "kept.pt")
torch.save({"adapter": state, "settings": {"alpha": "8", "base": base}}, folder / "old.pt")
fine_tune.begin_with(model, folder / "kept.pt", given)
for name, change in (("adapter.gguf", {"base": folder / "other.gguf"}), ("adapter.gguf", {"alpha": 16}), ("adapter.gguf", {"base": folder / "none.gguf"}),
                     ("kept.pt", {"base": folder / "other.gguf"}), ("kept.pt", {"alpha": 16}), ("kept.pt", {"base": folder / "none.gguf"}), ("old.pt", {})):
    try:
        fine_tune.begin_with(model, folder / name, argparse.Namespace(**{**vars(given), **change}))
    except fine_tune.Problem as problem:
        refused.append(str(problem))
print(json.dumps({"alpha": alpha, "same": sorted(back) == sorted(state) and all(torch.equal(back[k], state[k]) for k in state),
                  "begun": all(torch.equal(begun[k], state[k]) for k in state), "refused": refused}))
""", tmp_path)
    assert told["alpha"] == 8 and told["same"] and told["begun"]
    refused = told["refused"]
    for of_kind in (refused[:3], refused[3:6]):  # the file that it wrote, and what it kept
        assert "got one of other weights" in of_kind[0] and "want --alpha 8, got 16" in of_kind[1] and "none.gguf" in of_kind[2]
    assert "old.pt" in refused[6] and "or one that does not tell of which" in refused[6] and len(refused) == 7
    assert not any("\n" in one for one in refused)


@needs_environment
def test_going_on_with_other_contents_is_refused(tmp_path):
    told = in_environment(TINY + """
import argparse, pathlib
place = pathlib.Path(sys.argv[1])
def training(contents):
    made = object.__new__(fine_tune.Training)
    made.given, made.model = argparse.Namespace(output=place), model
    made.settings, made.contents = {"steps": "2"}, contents
    made.optimizer = torch.optim.AdamW([p for p in model.parameters() if p.requires_grad])
    made.curve, made.tokens, made.seconds = [[1, 10, 0.5, None, 1.0]], 10, 1.0
    return made
training({"train.jsonl": "abc"}).keep()
gone_on = training({"train.jsonl": "abc"}).go_on()
try:
    refused = training({"train.jsonl": "def"}).go_on()
except fine_tune.Problem as problem:
    refused = str(problem)
print(json.dumps({"gone_on": gone_on, "refused": refused}))
""", tmp_path)
    assert told["gone_on"] == 1 and "kept.pt: is of other settings or of files with other contents (train.jsonl);" in told["refused"]


# What a program ends with, and what it says.
ENDS = """
import contextlib, io
def end_of(main, *arguments):
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        try:
            code = main([str(one) for one in arguments])
        except SystemExit as end:
            code = end.code
    return [code, said.getvalue()]
"""


@needs_environment
def test_bad_input_is_told_in_one_line(tmp_path):
    tune = lambda *arguments: subprocess.run([PYTHON, TRAINING / "fine_tune.py", *map(str, arguments)], capture_output=True, text=True)
    none = tune(tmp_path, tmp_path / "none.gguf", tmp_path / "out")
    assert none.returncode == 3 and "none.gguf: want the model's weights" in none.stderr and none.stderr.count("\n") == 1
    replies = write(tmp_path / "replies.jsonl", {"schema": "saca.example_replies/2", "replies": 0})
    (tmp_path / "system.txt").write_bytes(b"\xff")
    told = in_environment(TINY + ENDS + """
import agreement, pathlib
folder = pathlib.Path(sys.argv[1])
fine_tune.load = lambda base: (lambda text, add_special_tokens: {"input_ids": letters(text)}, transformers.LlamaForCausalLM(config))
options = [["--steps", "0"], ["--answer-weight", "0"], ["--answer-weight", "nan"], ["--threads", "-1"]]
compared = [["--count", "0"], ["--rank", "0"], ["--temperature", "0"]]
files = [folder / "replies.jsonl", folder / "system.txt", folder / "base.gguf", folder / "adapter.gguf"]
print(json.dumps([*(end_of(fine_tune.main, folder, folder / "base.gguf", folder / "out", *one) for one in [*options, []]),
                  *(end_of(agreement.main, *files, *one) for one in [*compared, []])]))
""", tmp_path)
    for (code, said), (wanted, words) in zip(told, ((2, "--steps: want at least 1, got 0"), (2, "--answer-weight: want a number above 0, got 0"),
                                                    (2, "--answer-weight: want a number above 0, got nan"), (2, "--threads: want at least 0, got -1"),
                                                    (3, f"fine_tune: error: {tmp_path}/system.txt: want UTF-8"), (2, "--count: want at least 1, got 0"),
                                                    (2, "--rank: want at least 1, got 0"), (2, "--temperature: want a number above 0, got 0"),
                                                    (3, f"agreement: error: {tmp_path}/system.txt: want UTF-8")), strict=True):
        assert code == wanted and words in said


@needs_environment
def test_an_interrupted_training_ends_with_the_same_adapter(tmp_path):
    """Four steps at once, or two, interrupted, and two more."""
    (tmp_path / "sets").mkdir()
    (tmp_path / "sets/system.txt").write_text("rules")
    (tmp_path / "base.gguf").write_bytes(b"weights")
    made = [dict(EXAMPLE, record=f"fars_{k}", prompt=f"{k} AEB: clear", choice=k, admissible=[k, 7], reply=f"Scenario Analysis\n1. So it is.\nResponse to user: {k}") for k in range(6)]
    for name, some in (("train", made), ("calibration", made[:2])):
        write(tmp_path / f"sets/{name}.jsonl", dict(HEADER, examples=len(some)), *some)
    told = in_environment(TINY + ENDS + """
import pathlib
folder = pathlib.Path(sys.argv[1])
class Letters:
    eos_token_id = 299
    def __call__(self, text, add_special_tokens):
        return {"input_ids": letters(text)}
def load(base):
    torch.manual_seed(1)
    return Letters(), transformers.LlamaForCausalLM(transformers.LlamaConfig(vocab_size=300, hidden_size=16, intermediate_size=16, num_hidden_layers=1, num_attention_heads=2,
                                                                             num_key_value_heads=1, max_position_embeddings=512, initializer_range=0.2)).eval()
fine_tune.load = load
begun = fine_tune.Training.step
def interrupted(training, step):
    if step == 2:
        raise KeyboardInterrupt
    return begun(training, step)
run = lambda name: end_of(fine_tune.main, folder / "sets", folder / "base.gguf", folder / name, "--steps", 4, "--batch", 2, "--rank", 2, "--warm-up", 2, "--threads", 1,
                          "--keep-every", 1, "--twin-share", 1, "--single-share", 1)
ends = [run("at_once")]
fine_tune.Training.step = interrupted
ends.append(run("interrupted"))
fine_tune.Training.step = begun
ends.append(run("interrupted"))
print(json.dumps(ends))
""", tmp_path)
    assert [code for code, _ in told] == [0, 130, 0] and "run it again, it goes on" in told[1][1] and "step 3 of 4" in told[2][1] and "step 2 of 4" not in told[2][1]
    at_once, interrupted = (tmp_path / name for name in ("at_once", "interrupted"))
    assert (at_once / "adapter.gguf").read_bytes() == (interrupted / "adapter.gguf").read_bytes()
    columns = lambda folder: [row.split(",")[:4] for row in (folder / "curve.csv").read_text().splitlines()]  # all but the seconds
    assert columns(at_once) == columns(interrupted) and len(columns(at_once)) == 1 + 4
    steps = json.loads((interrupted / "training.json").read_text())
    assert steps["sha256"] == {f"{folder}/{name}": kept.sha256_of(tmp_path / folder / name) for folder, name in (
        ("sets", "system.txt"), ("sets", "train.jsonl"), ("sets", "calibration.jsonl"))} | {f"{tmp_path.name}/base.gguf": kept.sha256_of(tmp_path / "base.gguf")}


REPLY = {"schema": "saca.example_reply/2", "example": EXAMPLE, "reasoning": "So it is.", "first": [0.125] * 8, "last": [0.125] * 8, "ended": False}


@needs_environment
def test_agreement_reads_replies_and_temperatures(tmp_path):
    header = {"schema": "saca.example_replies/2", "replies": 1}
    bad = [((), ":1: want a header of saca.example_replies/2"), (([1], REPLY), ":1: want a header"), (({"schema": "saca.cases/1"}, REPLY), ":1: want a header"),
           ((dict(header, replies=3), REPLY), ": want 3 replies, got 1: it is cut"), ((header, [1]), ":2: want a reply as JSON"),
           ((header, {key: value for key, value in REPLY.items() if key != "first"}), ":2: want the key 'first'"),
           ((header, dict(REPLY, example={})), ":2: want the key 'prompt'"), ((header, dict(REPLY, reasoning=None)), ":2: want a text as reasoning, got None"),
           ((header, dict(REPLY, last=[0.5, 0.5])), ":2: want eight numbers or null as last, got [0.5, 0.5]")]
    for k, (documents, _) in enumerate(bad):
        write(tmp_path / f"{k}.jsonl", *documents)
    write(tmp_path / "good.jsonl", dict(header, replies=2), REPLY, dict(REPLY, first=None))
    (tmp_path / "some.toml").write_text('[[weights]]\nname = "saca"\ntemperature = 2.0\n[[weights]]\nname = "saca-tuned"\ntemperature = 4\n')
    (tmp_path / "bad.toml").write_text('[[weights]]\nname = "saca"\n')
    told = in_environment(TINY + """
import agreement, pathlib
folder = pathlib.Path(sys.argv[1])
refused = []
for read in (*(lambda k=k: agreement.read_replies(folder / f"{k}.jsonl") for k in range(int(sys.argv[2]))), lambda: agreement.temperature_of(folder / "bad.toml", "saca")):
    try:
        read()
    except fine_tune.Problem as problem:
        refused.append(str(problem))
reply = {"example": {"prompt": "a"}, "reasoning": "b", "ended": False}
asked = [agreement.asked_tokens(one, kind, letters) for one, kind in ((reply, "first"), (reply, "last"), (reply | {"ended": True, "reasoning": "b Response to user:"}, "last"))]
soft = torch.softmax(torch.tensor([3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], dtype=torch.float64) / 2.5, 0).tolist()
one_hot = lambda k, p: [p if k == j else (1 - p) / 7 for j in range(8)]
print(json.dumps({"refused": refused, "good": len(agreement.read_replies(folder / "good.jsonl")),
                  "temperatures": [agreement.temperature_of(folder / "some.toml", name) for name in ("saca-SmolLM2", "saca-tuned-Q8", "other")],
                  "shipped": agreement.temperature_of(agreement.TEMPERATURES, agreement.TUNED),
                  "asked": [one == letters(text) for one, text in zip(asked, ("a" + examples.PROMPT_TAIL + " Response to user: ", "a" + examples.PROMPT_TAIL + "b Response to user: ",
                                                                              "a" + examples.PROMPT_TAIL + "b Response to user: "))],
                  "sharpened": agreement.sharpened(soft, 2.5), "plain": torch.softmax(torch.tensor([3.0, 1.0, 0, 0, 0, 0, 0, 0]), 0).tolist(),
                  "compared": agreement.compare([(one_hot(1, 0.5), one_hot(1, 0.75)), (one_hot(1, 0.5), one_hot(2, 0.5))])}))
""", tmp_path, len(bad))
    for k, (said, (_, words)) in enumerate(zip(told["refused"], bad)):
        assert said.startswith(f"{tmp_path}/{k}.jsonl{words}") and "\n" not in said
    assert told["refused"][-1].startswith(f"{tmp_path}/bad.toml: want names and temperatures") and len(told["refused"]) == len(bad) + 1
    assert told["good"] == 1 and told["temperatures"] == [2.0, 4.0, 1.0] and told["shipped"] != 1.0 and told["asked"] == [True] * 3
    assert told["sharpened"] == pytest.approx(told["plain"]) and told["compared"] == {"compared": 2, "same": 1, "largest_shift": pytest.approx(0.5 - 0.5 / 7)}


@needs_environment
def test_agreement_undoes_the_temperature_of_the_tuned_weights(tmp_path):
    """Replies of the model itself, softened by the shipped temperature: no probability differs."""
    (tmp_path / "base.gguf").write_bytes(b"weights")
    (tmp_path / "system.txt").write_text("rules")
    told = in_environment(TINY + ENDS + """
import agreement, adapter, pathlib, peft
folder = pathlib.Path(sys.argv[1])
state = {key: torch.randn(value.shape).half().float() * 0.1 for key, value in peft.get_peft_model_state_dict(model).items()}
adapter.write_adapter(folder / "adapter.gguf", state, config, 32, folder / "base.gguf", "test")
def load(base):
    torch.manual_seed(2)
    return (lambda text, add_special_tokens: {"input_ids": letters(text)}), transformers.LlamaForCausalLM(config).eval()
fine_tune.load = load
given.base = folder / "base.gguf"
model = fine_tune.with_adapter(load(given.base)[1], given)
fine_tune.begin_with(model, folder / "adapter.gguf", given)
reader, replies = agreement.Reader(model), []
system = examples.system_tokens(letters, "rules")
for prompt in ("a scene", "a scene that is longer"):
    reply = {"example": {"prompt": prompt}, "reasoning": "so it is", "ended": False}
    for kind in agreement.KINDS:
        right = reader.probabilities(system + agreement.asked_tokens(reply, kind, letters), digits)
        reply[kind] = agreement.sharpened(right, 1 / agreement.temperature_of(agreement.TEMPERATURES, agreement.TUNED))
    replies.append(reply)
(folder / "replies.jsonl").write_text("".join(json.dumps(one) + "\\n" for one in [{"schema": agreement.REPLIES_SCHEMA, "replies": 2}, *replies]))
files = [folder / "replies.jsonl", folder / "system.txt", folder / "base.gguf", folder / "adapter.gguf", "--rank", "4", "--json"]
found = []
for more in ([], ["--temperature", "1"]):
    code, said = end_of(agreement.main, *files, *more)
    found.append([code, json.loads(said)["files"][0]["last"]])
print(json.dumps(found))
""", tmp_path)
    (code, by_itself), (_, without) = told
    assert code == 0 and by_itself["same"] == 2 and by_itself["largest_shift"] < 1e-4 < 1e-2 < without["largest_shift"]


@pytest.fixture
def clone(tmp_path):
    """A checkout with programs that note their calls; `saca` exits as the file `code` says."""
    for name in ("training/run.sh", "training/requirements.txt", "training/curve.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    digest = hashlib.sha256((TRAINING / "requirements.txt").read_bytes()).hexdigest()
    tuned = tmp_path / "runs/training/tuned"
    for path, text in (("build/release/saca", 'case $2 in build | export) exit "$(cat code)";; esac\n'),
                       ("build/training/bin/python", f'mkdir -p {tuned}; cd {tuned}; touch adapter.gguf training.json\n'
                        'printf "step,tokens,loss,calibration_loss,seconds\\n1,1,2,,1\\n2,2,1,,2\\n" > curve.csv\n')):
        (tmp_path / path).parent.mkdir(parents=True)
        (tmp_path / path).write_text('#!/bin/sh\necho "$@" >> calls\n' + text)
        (tmp_path / path).chmod(0o755)
    (tmp_path / f"build/training/ready-{digest[:16]}").touch()
    for folder in ("data/memory", "models/language", "docs/language_model"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "data/memory/seed.jsonl.gz").write_bytes(gzip.compress(b""))
    return tmp_path


@pytest.mark.parametrize("code, end", [(0, 0), (5, 0), (3, 3), (130, 130)])
def test_records_that_could_not_be_played_do_not_block_a_training(clone, code, end):
    (clone / "code").write_text(str(code))
    run = subprocess.run([clone / "training/run.sh", "all", "fars"], cwd=clone, capture_output=True, text=True)
    assert run.returncode == end, run.stderr
    assert (clone / "models/language/adapter.gguf").exists() == (end == 0)
    said = run.stderr.splitlines()
    assert [line for line in said if "could not be played" in line] == (
        [f"training: cases {word}: some records could not be played: they are left out" for word in ("build", "export", "export")] if code == 5 else [])


def test_the_curve_is_drawn(tmp_path):
    table = tmp_path / "curve.csv"
    table.write_text("step,tokens,loss,calibration_loss,seconds\n1,10,2.0,,1\n2,20,1.0,,2\n3,30,0.5,0.7,3\n")
    losses, judged = curve.read_curve(table)
    assert losses == [(1, 2.0), (2, 1.0), (3, 0.5)] and judged == [(3, 0.7)]
    assert curve.smoothed(losses)[-1] == (3, pytest.approx(3.5 / 3))
    assert curve.ticks(0.4, 12) == [0.5, 1.0, 2.0, 5.0, 10.0]
    curve.main([str(table), str(tmp_path / "curve.svg")])
    circles = [one.attrib for one in ElementTree.parse(tmp_path / "curve.svg").iter() if one.tag.endswith("circle")]
    down = [float(one["cy"]) for one in circles]
    assert down[0] < down[1] < down[2] and down[1] < down[3] < down[2]  # less loss is lower, and so is the judged one


def test_a_curve_is_not_written_over_and_a_missing_folder_is_told(tmp_path, monkeypatch):
    table = tmp_path / "curve.csv"
    table.write_text("step,tokens,loss,calibration_loss,seconds\n1,10,2.0,,1\n2,20,1.0,,2\n")
    (tmp_path / "other.csv").write_text(table.read_text())
    monkeypatch.chdir(tmp_path)
    (tmp_path / "link.svg").symlink_to(table)
    for output in ("./curve.csv", "link.svg"):
        with pytest.raises(SystemExit, match=f"{re.escape(output)}: want another file than the curves that are read"):
            curve.main(["other.csv", str(table), output])
    assert table.read_text() == (tmp_path / "other.csv").read_text()
    for name in ("none/all.csv", "none/all.svg"):
        with pytest.raises(SystemExit, match=f"curve: error: {name}: cannot write: No such file or directory"):
            curve.main([str(table), name])


def test_a_training_that_went_on_has_one_curve(tmp_path):
    for name, steps in (("first", 3), ("second", 2)):
        rows = "".join(f"{k},{10 * k},0.5,{0.25 if k == steps else ''},{1.5 * k}\n" for k in range(1, steps + 1))
        (tmp_path / f"{name}.csv").write_text("step,tokens,loss,calibration_loss,seconds\n" + rows)
    both = [str(tmp_path / f"{name}.csv") for name in ("first", "second")]
    curve.main([*both, str(tmp_path / "all.csv")])
    rows = (tmp_path / "all.csv").read_text().splitlines()
    assert [row.split(",")[0] for row in rows[1:]] == ["1", "2", "3", "4", "5"] and rows[3] == "3,30,0.5,0.25,4.5" and rows[-1] == "5,50,0.5,0.25,7.5"
    assert curve.read_curve(*both) == curve.read_curve(tmp_path / "all.csv")


def test_the_shipped_adapter_is_that_of_its_card():
    digest = hashlib.sha256((ROOT / "models/language/adapter.gguf").read_bytes()).hexdigest()
    card = (ROOT / "models/language/README.md").read_text()
    assert f"sha256 `{digest}`" in card
    losses, _ = curve.read_curve(ROOT / "models/language/curve.csv")
    assert len(losses) == sum(map(int, re.findall(r"\b(\d+) steps", card)))  # of its trainings


@pytest.mark.parametrize("text", ["", "step,loss\n1,2\n", "step,tokens,loss,calibration_loss,seconds\n1,1,x,,1\n",
                                  "step,tokens,loss,calibration_loss,seconds\n1,1,0,,1\n"])
def test_a_bad_curve_is_refused(tmp_path, text):
    (tmp_path / "curve.csv").write_text(text)
    with pytest.raises(SystemExit, match="curve.csv: want"):
        curve.main([str(tmp_path / "curve.csv"), str(tmp_path / "curve.svg")])
