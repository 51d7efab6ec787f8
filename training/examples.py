"""Examples as token sequences with branches, and which are learnt from together.

A language model reads an example's prompt once. From there on three replies begin, none of which sees the
others: the expert's reasoning with its answer; the answer at once; and the answer after the reasoning was cut at
a random token. So an answer that is asked for at any time is like what was learnt (`apps/model_host/engine.cpp`
asks so). All examples share the system part, whose tokens are evaluated once for a whole batch.
"""
import dataclasses
import json
import math
import pathlib
import random

SCHEMA = "saca.reply_examples/1"
SYSTEM_HEAD = "<|im_start|>system\n"
SYSTEM_TAIL = "<|im_end|>\n<|im_start|>user\n"
PROMPT_TAIL = "<|im_end|>\n<|im_start|>assistant\n"
ANSWER_STEM = " Response to user:"
ANSWERS = 8
NOTHING = 7  # the answer to do nothing


class Problem(Exception):
    """What is wrong with what was given, for whoever gave it."""


@dataclasses.dataclass(frozen=True)
class Example:
    """A line of a set (`saca cases export`)."""

    record: str
    family: str
    twin: bool
    prompt: str
    reply: str
    choice: int
    admissible: tuple
    forecast: tuple  # harm by policy; None: cannot be driven
    known: tuple  # harm over draws by policy; None: not known


def read_text(path):
    """All of a file. Raises Problem, naming it."""
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise Problem(f"{path}: cannot read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise Problem(f"{path}: want UTF-8") from None


def lines_behind_header(path, schema, counted, command):
    """What follows a file's first line, which has the schema and says how many lines follow, as `counted`; `command` writes such files."""
    lines = read_text(path).splitlines()
    try:
        head = json.loads(lines[0]) if lines else {}
        told = head.get(counted) if head.get("schema") == schema else None
    except (ValueError, AttributeError):
        told = None
    if told is None:
        raise Problem(f"{path}:1: want a header of {schema}, as `{command}` writes it")
    if told != len(lines) - 1:
        raise Problem(f"{path}: want {told} {counted}, got {len(lines) - 1}: it is cut or was lengthened")
    return lines[1:]


def are_numbers(values):
    """Is there one for each policy?"""
    return isinstance(values, list | tuple) and len(values) == ANSWERS and all(isinstance(one, int | float) and math.isfinite(one) for one in values)


def read_set(path):
    """All examples of a file, in its order. Raises Problem, naming the line."""
    return [read_set_line(line, f"{path}:{i}") for i, line in enumerate(lines_behind_header(path, SCHEMA, "examples", "saca cases export"), start=2)]


def read_set_line(line, place):
    """One example; `place` names the line in errors."""
    try:
        found = json.loads(line)
        result = Example(*(found[key] for key in ("record", "family", "twin", "prompt", "reply")), int(found["choice"]),
                         *(tuple(found[key]) for key in ("admissible", "forecast", "known")))
    except (ValueError, TypeError) as error:
        raise Problem(f"{place}: want an example as JSON: {error}") from None
    except KeyError as error:
        raise Problem(f"{place}: want the key {error}") from None
    for key in ("prompt", "reply"):
        if not isinstance(found[key], str):
            raise Problem(f"{place}: want a text as {key}, got {found[key]}")
    if not result.reply.endswith(f"Response to user: {result.choice}") or result.choice not in range(ANSWERS):
        raise Problem(f"{place}: want a reply that ends with its choice, 0 to 7")
    if not all(isinstance(policy, int) and policy in range(ANSWERS) for policy in result.admissible):
        raise Problem(f"{place}: want policies, 0 to 7, as admissible, got {found['admissible']}")
    for key in ("forecast", "known"):
        if not are_numbers([0.0 if harm is None else harm for harm in found[key]]):
            raise Problem(f"{place}: want eight numbers or null as {key}, got {found[key]}")
    return result


def shares_of_answers(example, harm_scale):
    """How much each answer counts, 8 numbers that sum to 1: the expert's choice alone, or, with a scale above 0, every
    admissible one as exp(-harm / scale), where the harm of all of these is known and the expert does something.
    """
    known = {policy: example.known[policy] for policy in example.admissible}
    if harm_scale <= 0.0 or example.choice == NOTHING or example.choice not in known or None in known.values():
        known = {example.choice: 0.0}
        harm_scale = 1.0
    least = min(known.values())
    shares = [math.exp((least - known[policy]) / harm_scale) if policy in known else 0.0 for policy in range(ANSWERS)]
    return [share / sum(shares) for share in shares]


def system_tokens(tokens_of, system):
    return tokens_of(SYSTEM_HEAD) + tokens_of(system) + tokens_of(SYSTEM_TAIL)


@dataclasses.dataclass
class Sequence:
    """An example as tokens: its prompt, then branches.

    `branch` is 0 in the prompt, else the number of the branch; a token sees the prompt's and its own branch's up to
    itself, of the cut branch also `cut` tokens of the first branch. `weight` is that of the prediction *of* a token.
    """

    tokens: list
    branch: list
    position: list  # behind the system part
    weight: list
    source: list  # index of the token that it is predicted from
    cut: int
    at_once: int = -1  # index of the answer that no reasoning precedes
    shares: list = dataclasses.field(default_factory=list)  # of that answer: how much each counts


def sequence_of(example, tokens_of, end_token, answer_weight, rng, harm_scale=0.0):
    """One example's prompt and its three branches.

    tokens_of: text to tokens; end_token: that a reply ends with; answer_weight: of an answer, and of the words that
    name it in the last statement; rng: where the reasoning is cut; harm_scale: as of shares_of_answers, for the answer at once: the other two follow what was written.
    """
    prompt = tokens_of(example.prompt) + tokens_of(PROMPT_TAIL)
    stem = tokens_of(ANSWER_STEM) + tokens_of(" ")
    digit = tokens_of(str(example.choice))
    reply = tokens_of(example.reply)
    if len(digit) != 1 or reply[-1:] != digit:
        raise Problem(f"{example.record}: want a tokeniser in which the answer is a token of its own")
    made = Sequence(list(prompt), [0] * len(prompt), list(range(len(prompt))), [0.0] * len(prompt),
                    list(range(-1, len(prompt) - 1)), rng.randint(1, max(1, len(reply) - len(stem) - 1)))
    weights = [1.0] * (len(reply) - 1) + [answer_weight, 1.0]
    before, named = (tokens_of(example.reply[:place]) for place in _conclusion(example.reply))
    if named != reply[:len(named)]:
        raise Problem(f"{example.record}: want a tokeniser that ends a token where the choice's name ends, in {example.reply!r}")
    weights[len(before):len(named)] = [answer_weight] * (len(named) - len(before))
    _add_branch(made, 1, len(prompt), len(prompt) - 1, reply + [end_token], weights)
    _add_branch(made, 2, len(prompt), len(prompt) - 1, stem + digit, [0.0] * len(stem) + [answer_weight])
    made.at_once, made.shares = len(made.tokens) - 1, shares_of_answers(example, harm_scale)
    _add_branch(made, 3, len(prompt) + made.cut, len(prompt) + made.cut - 1, stem + digit,
                [0.0] * len(stem) + [answer_weight])
    return made


def _conclusion(reply):
    """From where to where the last statement names what is chosen: "So AEB" of "3. So AEB: it alone is possible."."""
    said = reply.rfind("\n")
    last = reply.rfind("\n", 0, max(said, 0)) + 1
    begin = reply.find(". ", last) + 1
    end = reply.find(":", last)
    return (begin, end) if 0 < begin < end < said else (0, 0)


def _add_branch(made, number, position, source, tokens, weights):
    begin = len(made.tokens)
    made.tokens += tokens
    made.branch += [number] * len(tokens)
    made.position += range(position, position + len(tokens))
    made.weight += weights
    made.source += [source, *range(begin, begin + len(tokens) - 1)]


def batches_of(lengths, size, epoch, seed):
    """The batches of an epoch, as lists of indices: drawn, but of examples that are about as long, since the shorter
    ones of a batch wait for the longest. The same for the same seed, however often training was interrupted.
    """
    rng = random.Random(f"{seed} {epoch}")
    order = list(range(len(lengths)))
    rng.shuffle(order)
    window = 8 * size
    batches = []
    for begin in range(0, len(order), window):
        part = sorted(order[begin:begin + window], key=lambda i: lengths[i])
        made = [part[i:i + size] for i in range(0, len(part), size)]
        rng.shuffle(made)
        batches += made
    return batches
