"""Whether the merged and rewritten weights decide as PyTorch does with the adapter.

usage: agreement.py REPLIES SYSTEM BASE ADAPTER [--also REPLIES ...] [--count N] [--json]
  REPLIES  of `saca cases eval --output`: prompts, what was written, and what was answered before and after it
  SYSTEM   system.txt of the sets
  BASE     GGUF file that the adapter was trained with
  ADAPTER  what training kept (kept.pt) or wrote (adapter.gguf)
PyTorch is given the same prompts and the same written text: so each answer is compared by itself. The temperature that
replies were written with is undone (--temperature; without it, that of data/language_model.toml for the tuned weights).
Several files (--also: of the same prompts, by weights in another format) take little longer than one. Exit code 1: in
more than two of a hundred another answer is the likeliest.
"""
import argparse
import json
import math
import pathlib
import sys
import tomllib

import torch
import transformers

import examples
import fine_tune
from examples import Problem

REPLIES_SCHEMA = "saca.example_replies/2"
KINDS = ("first", "last")
TEMPERATURES = pathlib.Path(__file__).resolve().parents[1] / "data/language_model.toml"
TUNED = "saca-SmolLM2-135M"  # with which the names of the weights begin that `make model` makes of the adapter


def read_replies(path):
    """The replies of a file that have both answers. Raises Problem, naming the line."""
    lines = examples.lines_behind_header(path, REPLIES_SCHEMA, "replies", "saca cases eval")
    replies = [read_reply(line, f"{path}:{i}") for i, line in enumerate(lines, start=2)]
    return [one for one in replies if one["first"] and one["last"]]


def read_reply(line, place):
    """One reply; `place` names the line in errors."""
    try:
        found = json.loads(line)
        example, reasoning, _, *answers = (found[key] for key in ("example", "reasoning", "ended", *KINDS))
        texts = {"prompt": example["prompt"], "reasoning": reasoning}
    except (ValueError, TypeError) as error:
        raise Problem(f"{place}: want a reply as JSON: {error}") from None
    except KeyError as error:
        raise Problem(f"{place}: want the key {error}") from None
    for key, text in texts.items():
        if not isinstance(text, str):
            raise Problem(f"{place}: want a text as {key}, got {text}")
    for kind, answer in zip(KINDS, answers):
        if answer is not None and not examples.are_numbers(answer):
            raise Problem(f"{place}: want eight numbers or null as {kind}, got {answer}")
    return found


def temperature_of(path, weights):
    """What a file like data/language_model.toml has for weights with this name, as saca/lab/model_access/weights.cpp reads it."""
    try:
        listed = tomllib.loads(examples.read_text(path))["weights"]
        return [1.0, *(float(one["temperature"]) for one in listed if weights.startswith(one["name"]))][-1]
    except (ValueError, KeyError, TypeError) as error:
        raise Problem(f"{path}: want names and temperatures of weights: {error!r}") from None


def asked_tokens(reply, kind, tokens_of):
    """A reply's prompt, with what was written where the answer came after it, and the question for the answer."""
    tokens = tokens_of(reply["example"]["prompt"]) + tokens_of(examples.PROMPT_TAIL)
    written = reply["reasoning"] if kind == "last" else ""
    tokens += tokens_of(written)
    asks_itself = reply["ended"] and written.endswith(examples.ANSWER_STEM.strip())
    return tokens + ([] if asks_itself else tokens_of(examples.ANSWER_STEM)) + tokens_of(" ")


class Reader:
    """Reads texts one after the other, and what a text shares with the one before only once."""

    def __init__(self, model):
        self.causal = model.get_base_model()
        self.cache = transformers.DynamicCache()
        self.read = []

    def probabilities(self, tokens, choices):
        """Of these tokens to come next, among themselves."""
        shared = 0
        while shared < min(len(self.read), len(tokens) - 1) and self.read[shared] == tokens[shared]:
            shared += 1
        if shared < len(self.read):
            self.cache.crop(shared - len(self.read))  # so many from the end
        with torch.no_grad():
            told = self.causal(input_ids=torch.tensor([tokens[shared:]]), past_key_values=self.cache, use_cache=True, logits_to_keep=1)
        self.read = tokens
        return torch.softmax(told.logits[0, -1, choices], 0).tolist()


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
    parser.add_argument("--also", type=pathlib.Path, action="append", default=[], metavar="REPLIES")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--rank", type=int, default=16)
    parser.add_argument("--alpha", type=int, default=32)
    parser.add_argument("--temperature", type=float, help=f"that the replies were written with; without, that of data/language_model.toml for {TUNED}")
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args(arguments)
    for name in ("count", "rank", "alpha"):
        if getattr(given, name) < 1:
            parser.error(f"--{name}: want at least 1, got {getattr(given, name)}")
    if given.temperature is not None and not 0.0 < given.temperature < math.inf:
        parser.error(f"--temperature: want a number above 0, got {given.temperature:g}")
    try:
        temperature = given.temperature or temperature_of(TEMPERATURES, TUNED)
        rules = examples.read_text(given.system)
        paths = [given.replies, *given.also]
        files = [read_replies(path)[:given.count] for path in paths]
        for path, replies in zip(paths, files):
            if not replies:
                raise Problem(f"{path}: want replies with answers, got none")
            if [one["example"]["prompt"] for one in replies] != [one["example"]["prompt"] for one in files[0]]:
                raise Problem(f"{path}: want replies to the prompts of {paths[0]}, got others")
        tokenizer, base = fine_tune.load(given.base)
        tokens_of = fine_tune.tokeniser(tokenizer)
        given.seed = 1
        model = fine_tune.with_adapter(base, given)
        fine_tune.begin_with(model, given.adapter, given)
        system = examples.system_tokens(tokens_of, rules)
    except (Problem, OSError) as error:
        print(f"agreement: error: {error}", file=sys.stderr)
        return 3
    digits = [tokens_of(str(k))[0] for k in range(8)]
    reader = Reader(model)
    pairs = [{kind: [] for kind in KINDS} for _ in files]
    for same_prompt in zip(*files):
        for reply, of_file in zip(same_prompt, pairs):
            for kind in KINDS:
                theirs = sharpened(reply[kind], temperature)
                of_file[kind].append((theirs, reader.probabilities(system + asked_tokens(reply, kind, tokens_of), digits)))
    told = [{"replies": str(path), **{kind: compare(of_file[kind]) for kind in KINDS}} for path, of_file in zip(paths, pairs)]
    disagree = any(one[kind]["same"] < 0.98 * one[kind]["compared"] for one in told for kind in KINDS)
    if given.json:
        print(json.dumps({"schema": "saca.agreement/2", "files": told}))
        return int(disagree)
    for one in told:
        for kind, title in zip(KINDS, ("at once", "after reasoning")):
            found = one[kind]
            print(f"{one['replies']}: {title}: {found['same']} of {found['compared']} the same, "
                  f"probabilities differ by at most {found['largest_shift']:.3f}")
    return int(disagree)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
