"""Teaches the shipped language model the expert's choice and reasoning: low-rank adapters (LoRA).

usage: fine_tune.py SETS BASE OUTPUT [options]
  SETS    folder of `saca cases export`: system.txt, train.jsonl, calibration.jsonl
  BASE    the model's GGUF file; its weights stay as they are
  OUTPUT  folder for adapter.gguf, curve.csv, and what resuming takes

Can be interrupted at any time: run again, it goes on from the last kept step. What was kept with other settings, or
of sets, weights or an adapter to begin with of other contents, is refused. Same seed, sets and threads, same adapter.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import sys
import time

import peft
import torch
import transformers

import adapter
import batch as batches
import examples
import kept
from examples import Problem

MODULES = [name.split(".")[1] for name in adapter.NAMES]


def options(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sets", type=pathlib.Path)
    parser.add_argument("--also", type=pathlib.Path, action="append", default=[], metavar="SETS", help="other examples of the same rules")
    parser.add_argument("base", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=400, help="of --batch examples each")
    parser.add_argument("--batch", type=int, default=4)
    parser.add_argument("--rank", type=int, default=16)
    parser.add_argument("--alpha", type=int, default=32)
    parser.add_argument("--rate", type=float, default=8e-4, help="of learning, at its highest")
    parser.add_argument("--warm-up", type=int, default=25, help="steps until then")
    parser.add_argument("--answer-weight", type=float, default=5.0, help="of an answer's digit, and of its name in the last statement; of other tokens 1")
    parser.add_argument("--harm-scale", type=float, default=0.0,
                        help="above 0: the answer at once is taught as exp(-harm / this) over what is admissible")
    parser.add_argument("--twin-share", type=float, default=0.5, help="of the scenes without risk")
    parser.add_argument("--single-share", type=float, default=0.5, help="of the scenes in which one policy alone is admissible")
    parser.add_argument("--begin-with", type=pathlib.Path, default=None, help="what another training kept (kept.pt) or wrote (adapter.gguf): begins with its adapter")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=0, help="0: all cores")
    parser.add_argument("--keep-every", type=int, default=20, help="steps")
    parser.add_argument("--judge-every", type=int, default=50, help="steps: loss on a part of the calibration set")
    given = parser.parse_args(arguments)
    for name in ("steps", "batch", "rank", "alpha", "keep_every", "judge_every"):
        if getattr(given, name) < 1:
            parser.error(f"--{name.replace('_', '-')}: want at least 1, got {getattr(given, name)}")
    if not 0.0 < given.answer_weight < math.inf:
        parser.error(f"--answer-weight: want a number above 0, got {given.answer_weight:g}")
    if given.threads < 0:
        parser.error(f"--threads: want at least 0, got {given.threads}")
    return given


def load(base):
    if not base.is_file():
        raise Problem(f"{base}: want the model's weights (make model), there is no such file")
    place = {"pretrained_model_name_or_path": base.parent, "gguf_file": base.name}
    try:
        tokenizer = transformers.AutoTokenizer.from_pretrained(**place)
        model = transformers.AutoModelForCausalLM.from_pretrained(**place, dtype=torch.float32, attn_implementation="sdpa")
    except (ValueError, OSError, KeyError) as error:
        raise Problem(f"{base}: want a GGUF file of a language model: {error}") from None
    model.eval()
    return tokenizer, model


def with_adapter(model, given):
    torch.manual_seed(given.seed)
    return peft.get_peft_model(model, peft.LoraConfig(r=given.rank, lora_alpha=given.alpha, target_modules=MODULES, lora_dropout=0.0))


def begin_with(model, place, given):
    """Takes the adapter of another training: what it kept, or what it wrote (.gguf)."""
    try:
        if place.suffix == ".gguf":
            state, alpha = adapter.read_adapter(place, model.config, given.base)
        else:
            before = torch.load(place, weights_only=True)
            state, settings = before["adapter"], before["settings"]
            alpha = float(settings["alpha"])
            if settings.get(settings["base"]) != kept.sha256_of(given.base):
                raise adapter.OtherAdapter(f"want an adapter of {given.base}, got one of other weights, or one that does not tell of which")
        if alpha != given.alpha:
            raise adapter.OtherAdapter(f"want --alpha {alpha:g}, got {given.alpha}")
        own = peft.get_peft_model_state_dict(model)
        if {key: value.shape for key, value in own.items()} != {key: value.shape for key, value in state.items()}:
            raise adapter.OtherAdapter(f"want the layers and the rank ({given.rank}) of this one")
        peft.set_peft_model_state_dict(model, state)
    except Exception as error:  # of several kinds, none of which the libraries name
        raise Problem(f"{place}: want a training that was kept, or its adapter: {error}") from None


def rules_of(folders):
    """The system part that all these sets share."""
    rules = [examples.read_text(folder / "system.txt") for folder in folders]
    for folder, text in zip(folders, rules):
        if text != rules[0]:
            raise Problem(f"{folder / 'system.txt'}: want the rules of {folders[0]}, got others")
    return rules[0]


def tokeniser(tokenizer):
    known = {}

    def tokens_of(text):
        if text not in known:
            known[text] = tokenizer(text, add_special_tokens=False)["input_ids"]
        return list(known[text])

    return tokens_of


def logits_of(model, system, batch):
    """Of what is predicted, [N, vocabulary]. The system part is evaluated once, gradients flow through it."""
    causal = model.get_base_model()
    count = len(batch.tokens)
    begin = causal.model(input_ids=torch.tensor([system]), use_cache=True).past_key_values
    begin.batch_repeat_interleave(count)
    hidden = causal.model(input_ids=batch.tokens, position_ids=batch.positions + len(system), attention_mask=batch.unseen,
                          past_key_values=begin, use_cache=True).last_hidden_state
    return causal.lm_head(hidden[batch.rows, batch.sources])


def loss_of(model, system, batch, digits):
    """digits: the tokens of the eight answers."""
    logits = logits_of(model, system, batch)
    losses = torch.nn.functional.cross_entropy(logits, batch.targets, reduction="none")
    answers = torch.log_softmax(logits[batch.at_once], dim=-1)[:, digits]
    losses = losses.index_copy(0, batch.at_once, -(batch.shares * answers).sum(dim=-1))
    return (losses * batch.weights).sum() / batch.weights.sum()


def rate_at(step, given):
    """Share of the highest rate: rises over the warm-up, then falls as a cosine to nothing."""
    if step < given.warm_up:
        return (step + 1) / given.warm_up
    return 0.5 * (1.0 + math.cos(math.pi * (step - given.warm_up) / max(1, given.steps - given.warm_up)))


def chosen_examples(all_of_set, given):
    """All scenes with risk in which there is a choice, and a share of the others, which are learnt sooner."""
    rng = random.Random(f"{given.seed} chosen")
    share = lambda one: (given.twin_share if one.twin else 1.0) * (given.single_share if len(one.admissible) == 1 else 1.0)
    return [one for one in all_of_set if rng.random() < share(one)]


class Training:
    def __init__(self, given):
        self.given = given
        self.settings = {key: str(value) for key, value in vars(given).items() if key not in ("output", "threads", "keep_every")}
        self.tokenizer, base = load(given.base)
        self.tokens_of = tokeniser(self.tokenizer)
        self.model = with_adapter(base, given)
        if given.begin_with:
            begin_with(self.model, given.begin_with, given)
        self.system = examples.system_tokens(self.tokens_of, rules_of([given.sets, *given.also]))
        self.digits = [self.tokens_of(str(answer))[0] for answer in range(examples.ANSWERS)]
        self.train = chosen_examples(self.read("train.jsonl"), given)
        self.lengths = [len(one.prompt) + len(one.reply) for one in self.train]
        self.judged = self.read("calibration.jsonl")
        if not self.train or not self.judged:
            raise Problem(f"{given.sets}: want examples to train with and to judge by, got {len(self.train)} and {len(self.judged)}")
        self.contents = kept.contents([given.sets, *given.also], [given.base, *([given.begin_with] if given.begin_with else [])])
        self.optimizer = torch.optim.AdamW([p for p in self.model.parameters() if p.requires_grad], lr=given.rate)
        self.curve = []  # step, tokens so far, loss, judged loss or nothing, seconds
        self.tokens = 0
        self.seconds = 0.0

    def read(self, name):
        return [one for folder in [self.given.sets, *self.given.also] for one in examples.read_set(folder / name)]

    def batch(self, chosen, name):
        rng = random.Random(f"{self.given.seed} {name}")
        made = [examples.sequence_of(one, self.tokens_of, self.tokenizer.eos_token_id, self.given.answer_weight, rng, self.given.harm_scale)
                for one in chosen]
        return batches.batch_of(made, len(self.system), self.tokenizer.eos_token_id), sum(len(one.tokens) for one in made)

    def judge(self):
        """Loss on a fixed part of the calibration set, twelve batches at most."""
        lengths = [len(one.prompt) for one in self.judged]
        losses = []
        with torch.no_grad():
            for part in examples.batches_of(lengths, self.given.batch, 0, 0)[:12]:
                batch, _ = self.batch([self.judged[i] for i in part], f"judged {part}")
                losses.append(loss_of(self.model, self.system, batch, self.digits).item())
        return sum(losses) / len(losses)

    def indices_at(self, step):
        """Of the examples of a step."""
        in_epoch = -(-len(self.train) // self.given.batch)
        return examples.batches_of(self.lengths, self.given.batch, step // in_epoch, self.given.seed)[step % in_epoch]

    def step(self, step):
        for group in self.optimizer.param_groups:
            group["lr"] = self.given.rate * rate_at(step, self.given)
        batch, tokens = self.batch([self.train[i] for i in self.indices_at(step)], f"step {step}")
        loss = loss_of(self.model, self.system, batch, self.digits)
        self.optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_([p for p in self.model.parameters() if p.requires_grad], 1.0)
        self.optimizer.step()
        self.tokens += tokens + len(self.system)
        return loss.item()

    def state(self):
        return peft.get_peft_model_state_dict(self.model)

    def keep(self):
        """All that going on takes, whole or not at all."""
        place = self.given.output / "kept.pt"
        torch.save({"settings": {**self.settings, **self.contents}, "adapter": self.state(), "optimizer": self.optimizer.state_dict(), "curve": self.curve,
                    "tokens": self.tokens, "seconds": self.seconds}, f"{place}.part")
        pathlib.Path(f"{place}.part").rename(place)

    def go_on(self):
        """Takes up what was kept. Returns the number of steps that are done."""
        place = self.given.output / "kept.pt"
        if not place.exists():
            return 0
        try:
            before = torch.load(place, weights_only=True)
        except Exception as error:  # of several kinds, none of which the library names
            raise Problem(f"{place}: want a training that was kept: {error}; remove it to begin anew") from None
        kept.refuse_other(place, before["settings"], {**self.settings, **self.contents})
        peft.set_peft_model_state_dict(self.model, before["adapter"])
        self.optimizer.load_state_dict(before["optimizer"])
        self.curve, self.tokens, self.seconds = before["curve"], before["tokens"], before["seconds"]
        return len(self.curve)

    def write(self):
        with open(self.given.output / "curve.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["step", "tokens", "loss", "calibration_loss", "seconds"])
            writer.writerows(self.curve)
        adapter.write_adapter(self.given.output / "adapter.gguf", self.state(), self.model.get_base_model().config, self.given.alpha,
                              self.given.base, "SmolLM2-135M-Instruct for saca")
        told = {"schema": "saca.fine_tuning/1", **self.settings, "sets": self.given.sets.name, "base": self.given.base.name,
                "also": " ".join(folder.name for folder in self.given.also),
                "begin_with": self.given.begin_with.parent.name if self.given.begin_with else "",
                "sha256": kept.by_last_parts(self.contents),
                "examples": len(self.train), "tokens": self.tokens, "seconds": round(self.seconds),
                "calibration_loss": next((row[3] for row in reversed(self.curve) if row[3] is not None), None)}
        (self.given.output / "training.json").write_text(json.dumps(told, indent=2) + "\n")

    def run(self):
        done = self.go_on()
        for step in range(done, self.given.steps):
            begin = time.monotonic()
            loss = self.step(step)
            last = step + 1 == self.given.steps
            judged = self.judge() if last or (step + 1) % self.given.judge_every == 0 else None
            self.seconds += time.monotonic() - begin
            self.curve.append([step + 1, self.tokens, loss, judged, round(self.seconds, 1)])
            left = (self.given.steps - step - 1) * self.seconds / (step + 1)
            print(f"step {step + 1} of {self.given.steps}: loss {loss:.4f}" + (f", calibration {judged:.4f}" if judged is not None else "")
                  + f", {self.tokens / self.seconds:.0f} tokens/s, {left / 60:.0f} min left", file=sys.stderr, flush=True)
            if last or (step + 1) % self.given.keep_every == 0:
                self.keep()
        self.write()


def main(arguments):
    given = options(arguments)
    if given.threads:
        torch.set_num_threads(given.threads)
    transformers.utils.logging.disable_progress_bar()
    try:
        given.output.mkdir(parents=True, exist_ok=True)
        Training(given).run()
    except KeyboardInterrupt:
        print("fine_tune: interrupted; run it again, it goes on", file=sys.stderr)
        return 130
    except (Problem, OSError) as error:
        print(f"fine_tune: error: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
