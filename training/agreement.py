"""Whether the merged and rewritten weights decide as PyTorch does with the adapter.

usage: agreement.py REPLIES SYSTEM BASE ADAPTER [--count N] [--json]
  REPLIES  of `saca cases eval --output`: prompts, what was written, and what was answered before and after it
  SYSTEM   system.txt of the sets
  BASE     GGUF file that the adapter was trained with
  ADAPTER  what training kept (kept.pt) or wrote (adapter.gguf)
PyTorch is given the same prompts and the same written text: so each answer is compared by itself. Exit code 1: in more than
two of a hundred another answer is the likeliest.
"""
import argparse
import json
import pathlib
import sys

import torch

import examples
import fine_tune
from examples import Problem

REPLIES_SCHEMA = "saca.example_replies/1"
KINDS = ("first", "last")


def read_replies(path):
    try:
        lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
        documents = [json.loads(line) for line in lines]
    except (OSError, ValueError) as error:
        raise Problem(f"{path}: want lines of JSON: {error}") from None
    if not documents or documents[0].get("schema") != REPLIES_SCHEMA:
        raise Problem(f"{path}:1: want a header of {REPLIES_SCHEMA}, as `saca cases eval` writes it")
    return [one for one in documents[1:] if one["first"] and one["last"]]


def asked_tokens(reply, kind, tokens_of):
    """A reply's prompt, with what was written where the answer came after it, and the question for the answer."""
    tokens = tokens_of(reply["example"]["prompt"]) + tokens_of(examples.PROMPT_TAIL)
    written = reply["reasoning"] if kind == "last" else ""
    tokens += tokens_of(written)
    asks_itself = reply["ended"] and written.endswith(examples.ANSWER_STEM.strip())
    return tokens + ([] if asks_itself else tokens_of(examples.ANSWER_STEM)) + tokens_of(" ")


def probabilities(model, system, tokens, digits):
    with torch.no_grad():
        ids = torch.tensor([system + tokens])
        logits = model.get_base_model()(input_ids=ids, logits_to_keep=1).logits[0, -1, digits]
    return torch.softmax(logits, 0).tolist()


def compare(pairs):
    """pairs: of probabilities, theirs and PyTorch's."""
    same = sum(max(range(8), key=a.__getitem__) == max(range(8), key=b.__getitem__) for a, b in pairs)
    shift = max(abs(x - y) for a, b in pairs for x, y in zip(a, b))
    return {"compared": len(pairs), "same": same, "largest_shift": shift}


def sharpened(answer, temperature):
    """Undoes a temperature. The two differ by no more than rounding."""
    powers = [p ** temperature for p in answer]
    return [p / sum(powers) for p in powers]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("replies", "system", "base", "adapter"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--rank", type=int, default=16)
    parser.add_argument("--alpha", type=int, default=32)
    parser.add_argument("--temperature", type=float, default=1.0, help="of data/language_model.toml, for these weights")
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args(arguments)
    try:
        replies = read_replies(given.replies)[:given.count]
        if not replies:
            raise Problem(f"{given.replies}: want replies with answers, got none")
        tokenizer, base = fine_tune.load(given.base)
        tokens_of = fine_tune.tokeniser(tokenizer)
        given.seed = 1
        model = fine_tune.with_adapter(base, given)
        fine_tune.begin_with(model, given.adapter, given)
        system = examples.system_tokens(tokens_of, given.system.read_text(encoding="utf-8"))
    except (Problem, OSError) as error:
        print(f"agreement: error: {error}", file=sys.stderr)
        return 3
    digits = [tokens_of(str(k))[0] for k in range(8)]
    told = {}
    for kind in KINDS:
        pairs = [(sharpened(one[kind], given.temperature), probabilities(model, system, asked_tokens(one, kind, tokens_of), digits))
                 for one in replies]
        told[kind] = compare(pairs)
    disagree = any(one["same"] < 0.98 * one["compared"] for one in told.values())
    if given.json:
        print(json.dumps({"schema": "saca.agreement/1", **told}))
        return int(disagree)
    for kind, title in zip(KINDS, ("at once", "after reasoning")):
        one = told[kind]
        print(f"{title}: {one['same']} of {one['compared']} the same, probabilities differ by at most {one['largest_shift']:.3f}")
    return int(disagree)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
