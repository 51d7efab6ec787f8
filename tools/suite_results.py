#!/usr/bin/env python3
"""Makes docs/suites.md from the figures that `saca suite`, `ladder`, `forecast eval`, `tables`, `memory calibrate` and `cases eval` print with --json.

usage: tools/suite_results.py COMMIT FILE.json... [-- COMMIT FILE.json...]
           puts together files, each made on this machine at the commit named before it, as docs/suites.json, and writes docs/suites.md from it;
           their date is that of the file
       tools/suite_results.py
           writes docs/suites.md from docs/suites.json
       tools/suite_results.py add COMMIT FILE.json...
           the same with these files besides: each takes the place of the run of the same command
Of the single families only the regret is kept.
"""

import datetime
import json
import pathlib
import re
import subprocess
import sys

from figures import ROOT, Figures, interval, percent, processor, read_figures, read_json, table, write_whole

KEPT = ROOT / "docs" / "suites.json"
PAGE = ROOT / "docs" / "suites.md"
NUMBERS = ("harm", "regret", "regret_published", "collision_loss", "switches", "harm_over_aeb", "harm_over_first", "contact", "right", "materially_worse_than_aeb", "needless", "false_trigger_loss",
           "false_triggers", "twin_harm", "regret_over_aeb", "cache_hit_rate", "memory_hit_rate", "agrees_with_driver")


ORDER = ("saca", "saca_no_memory", "saca_no_model", "saca_untuned", "saca_unaware", "saca_no_reach", "saca_no_cues", "saca_at_t1", "saca_full_braking", "saca_reflex", "saca_paper",
         "saca_paper_at_once", "saca_paper_untuned", "saca_paper_unaware", "saca_paper_no_facts", "saca_paper_no_facts_at_once", "aeb", "r157", "cc_driver", "fsm", "rss", "rss_steering", "imitation", "imitation_drivers", "random", "nothing", "first_forecast",
         "newest_forecast", "going_on_atlas", "least_danger", "least_joint_danger", "beliefs_atlas", "beliefs_rolled_out", "beliefs_drawn",
         "beliefs_and_danger", "beliefs_and_experience", "beliefs_and_grip", "beliefs_and_followers",
         "beliefs_and_hidden", "true_atlas", "true_rolled_out", "oracle")  # as saca/lab/eval/methods.cpp has them


def trimmed(figures):
    """Without what is told of single families, but for the regret."""
    kept = {}
    for key, value in figures.items():
        parts = key.split(".")
        if parts[0] == "suite" and len(parts) > 4 and parts[3] not in NUMBERS and parts[3] not in ("source", "reason", "expected"):
            if (parts[4] != "regret" or len(parts) > 5) and parts[4] != "expected":
                continue
        if parts[0] == "forecast" and key.endswith((".n", ".lo", ".hi")) and "above_shipped" not in parts:
            continue
        kept[key] = value
    return kept


def merged(commit, files):
    """What is kept of these files, each made by a program of that commit."""
    runs = []
    known = subprocess.run(["git", "rev-parse", "--short", "--verify", commit + "^{commit}"], cwd=ROOT, capture_output=True, text=True)
    if known.returncode != 0:
        sys.exit(f"suite_results: want a commit of this repository, got {commit}")
    commit = known.stdout.strip()
    for file in files:
        figures = read_figures(file, "meta.command")
        built_from = figures.get("meta.built_from", "")
        if built_from and (commit[:7] not in built_from or "-dirty" in built_from):
            sys.exit(f'{file}: want figures of a program of commit {commit}, got those of "{built_from}"')
        figures["meta.processor"] = processor()
        figures["meta.date"] = datetime.date.fromtimestamp(pathlib.Path(file).stat().st_mtime).isoformat()
        figures["meta.commit"] = commit
        runs.append(trimmed(figures))
    return runs


def methods_of(figures, head):
    found = []
    for key in figures:
        match = re.fullmatch(re.escape(head) + r"([a-z_0-9]+)\.harm", key)
        if match and match.group(1) != "driver":
            found.append(match.group(1))
    return in_order(found)


def in_order(names):
    return sorted(names, key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name))


def decisions(figures, place, method):
    """One sentence on where the decisions of a method that thinks ahead came from; nothing where it had neither memory nor model."""
    forecasts = figures.get(place + "forecasts", 0)
    if not forecasts or not (figures.get("meta.memory") or figures.get("meta.model")):
        return []
    counted = {kind: ", ".join(f"{words} {figures[key]}" for key in sorted(figures) if key.startswith(place + kind + ".")
                               for words in [key[len(place + kind) + 1:]]) for kind in ("source", "reason")}
    return [f"\nDecisions of `{method}` by source: {counted['source']}; by reason: {counted['reason']}. Of {forecasts} forecasts memory knew "
            f"{figures[place + 'memory_hits']} ({percent(figures, place + 'memory_hit_rate')} %); the model answered {figures[place + 'model_answered']} of the "
            f"{figures[place + 'model_asked']} that it was asked about."]


EXPECTED = ("expected", "expected.happened", "expected.braking", "expected.braking_happened")


def expectations(figures, head, method, families):
    """What verdicts expected at T1 and what happened, over all and by family; nothing of a method that decides by none."""
    places = [("all", f"{head}{method}.")] + [(family, f"{head}{method}.{family}.") for family in families]
    lines = [[words, f"{figures[place + 'expected.n']}", *(interval(figures, place + key) for key in EXPECTED)]
             for words, place in places if place + "expected" in figures]
    if not lines:
        return []
    return [f"\nWhat the verdicts of `{method}` expected at T1 of what was decided on and of full braking, and the harm of the same plans begun at T1 "
            f"with full knowledge. {percent(figures, f'{head}{method}.expected.knowingly_worse')} % were knowingly worse than braking.\n",
            table(["family", "decisions", "expected", "happened", "of braking expected", "happened"], lines)]


def method_failures(figures, head, methods):
    """How often methods threw; since 2026-11-30 nobody's figures count such encounters (told as method_faults)."""
    failed = ", ".join(f"`{m}` {figures[f'{head}{m}.faults']}" for m in methods if figures.get(f"{head}{m}.faults"))
    if not failed:
        return ""
    counted = "these encounters are left out" if head + "method_faults" in figures else "they count with what had been done until then"
    return f" Encounters in which a method failed: {failed}; {counted}."


def suite_section(figures, name):
    head = f"suite.{name}."
    methods = methods_of(figures, head)
    named = re.search(r" --methods ([a-z0-9_]+)", figures.get("meta.command", ""))
    first = named[1] if named and f"{head}{named[1]}.harm_over_first" in figures else None

    def above_first(method):
        return [interval(figures, f"{head}{method}.harm_over_first")] if first else []

    has_twins = any(f"{head}{m}.twin_harm" in figures for m in methods)  # told since 2026-11-30

    def in_twins(method):
        return [interval(figures, f"{head}{method}.twin_harm")] if has_twins else []

    lines = [[f"`{m}`", interval(figures, f"{head}{m}.harm"), interval(figures, f"{head}{m}.regret"),
              interval(figures, f"{head}{m}.harm_over_aeb"), *above_first(m), percent(figures, f"{head}{m}.contact"),
              percent(figures, f"{head}{m}.right"), percent(figures, f"{head}{m}.materially_worse_than_aeb"),
              percent(figures, f"{head}{m}.needless"), interval(figures, f"{head}{m}.false_trigger_loss", 3).split(" ")[0], *in_twins(m)]
             for m in methods]
    text = [f"## Suite `{name}`, {figures[head + 'n']:,} encounters\n",
            f"{figures[head + 'faults']} could not be played.{method_failures(figures, head, methods)} Means with 95 % intervals; shares in per cent.\n",
            table(["method", "harm", "regret", "harm above AEB's", *([f"harm above that of `{first}`"] if first else []), "contact", "as good as the best",
                   "materially worse than AEB", "needless", "False-Trigger Loss", *(["harm in twins"] if has_twins else [])], lines)]
    families = sorted({key[len(head):].split(".")[1] for key in figures
                       if key.startswith(head) and len(key[len(head):].split(".")) == 3 and key.endswith(".regret")})
    if families:
        text += ["\nRegret by family:\n",
                 table(["method", *families], [[f"`{m}`", *(f"{figures.get(f'{head}{m}.{f}.regret', float('nan')):.4f}" for f in families)]
                                               for m in methods])]
    for m in methods:
        text += decisions(figures, f"{head}{m}.", m) + expectations(figures, head, m, families)
    if head + "driver.n" in figures:
        agreement = ", ".join(f"`{m}` {percent(figures, f'{head}{m}.agrees_with_driver')} %" for m in methods)
        text.append(f"\n{figures[head + 'driver.n']} recorded drivers: harm {figures[head + 'driver.harm']:.4f}, "
                    f"{figures[head + 'driver.met']} met somebody, {figures[head + 'driver.braked']} braked, "
                    f"{figures[head + 'driver.steered']} moved aside by half a metre. Of those who met nobody, methods do as the driver did in: {agreement}.")
    if head + "encounters_per_s_core" in figures:
        text.append(f"\n{figures[head + 'encounters_per_s_core']:.2f} encounters per second and core.")
    return "\n".join(text)


def ladder_section(figures, name):
    head = f"ladder.{name}."
    rungs = in_order([key[len(head):] for key in figures if re.fullmatch(re.escape(head) + r"[a-z_]+", key)])
    lines = []
    for rung in rungs:
        step = [key for key in figures if re.fullmatch(re.escape(f"{head}{rung}.step_from.") + r"[a-z_]+", key)]
        lines.append([f"`{rung}`", interval(figures, head + rung), interval(figures, step[0]) if step else "-",
                      f"`{step[0].rsplit('.', 1)[1]}`" if step else "-"])
    return "\n".join([f"## Ladder `{name}`\n", f"{figures[head + rungs[0] + '.n']} encounters. A step is what a rung loses against another, paired.\n",
                      table(["rung", "regret", "step", "against"], lines)])


def tables_section(figures):
    has_replies = any(key.startswith("tables.4.") for key in figures)
    text = [f"## Tables II{',' if has_replies else ' and'} III{' and IV' if has_replies else ''} of the paper, our rows\n"]
    for number in ("2", "2_late", "3"):
        head = f"tables.{number}."
        if not any(key.startswith(head) for key in figures):
            continue
        methods = in_order([key[len(head):-len(".collision_loss")] for key in figures
                            if re.fullmatch(re.escape(head) + r"[a-z0-9_]+\.collision_loss", key)])
        rows = [[f"`{m}`", interval(figures, f"{head}{m}.collision_loss.ten_draws", 2), interval(figures, f"{head}{m}.collision_loss", 2),
                 interval(figures, f"{head}{m}.false_trigger_loss.ten_draws", 2), interval(figures, f"{head}{m}.false_trigger_loss", 2),
                 interval(figures, f"{head}{m}.harm_over_aeb", 4)] for m in methods]
        columns = ["method", "Collision Loss, ten draws each", "all draws", "False-Trigger Loss, ten draws each", "all draws", "harm above AEB's, paired"]
        if any(key.startswith(head) and key.endswith(".in_time.n") for key in figures):
            columns.append("Collision Loss where each reply ended by itself, n")
            for row, m in zip(rows, methods):
                key = f"{head}{m}.collision_loss.in_time"
                row.append(f"{interval(figures, key, 2)}, {figures[key + '.n']}" if key in figures else "-")
        count = figures[f"{head}{methods[0]}.collision_loss.n"]
        text += [f"\nTable {'I' * int(number[0])}{' with a late truck (ours)' if 'late' in number else ''}, {count} encounters:\n",
                 table(columns, rows)]
    rows = []
    for key in sorted(key for key in figures if key.startswith("tables.4.") and key.endswith(".asked")):
        head = key[:-len("asked")]
        number, model = head.split(".")[2:4]
        rows.append([f"{'I' * int(number)}, {'the model' if model == 'model' else 'without fine-tuning'}", str(figures[key]), str(figures[head + "done"]), str(figures[head + "ended"]),
                     *(interval(figures, head + what, digits) if head + what in figures else "-" for what, digits in (("tokens", 0), ("seconds", 1))),
                     f"{figures[head + 'least_seconds']:.1f}" if head + "least_seconds" in figures else "-", str(figures[head + "in_time"])])
    if rows:
        text += ["\nTable IV, replies at real pace:\n", table(["scenes of table", "asked", "done", "ended", "tokens", "s", "least s", "done in time"], rows)]
    return "\n".join(text)


MODELS = ("constant_velocity", "constant_turn", "lane_following", "law", "particle_filter", "mixture_lstm", "shipped")  # as saca/lab/eval/forecast_score.cpp has them
TIMES = (500, 1000, 2000, 3000)
GROUPS = (("all", "All road users that move"), ("acting", "Those that act: after 2 s more than 1 m from where they would be, straight on"),
          ("aside", "Vehicles that are seen to move aside by more than 0.5 m/s"))
SCORES = (("nll", "negative log likelihood, ln m2", 1.0), ("miss_of_6", "least miss of 6, m", 1.0), ("missed", "more than 2 m off, %", 100.0),
          ("within_90_along", "in the 90 % region along, %", 100.0), ("within_90_across", "likewise across, %", 100.0),
          ("within_50_along", "in the 50 % region along, %", 100.0), ("within_50_across", "likewise across, %", 100.0))


def above_shipped(figures, place, models):
    """By how much the likelihood of each baseline is worse than that of what ships, paired, and whether it is worse than of all of them."""
    baselines = [model for model in models if f"{place}{TIMES[0]}ms.{model}.above_shipped.lo" in figures]
    if not baselines:
        return []
    lines = []
    for time in TIMES:
        keys = [f"{place}{time}ms.{model}.above_shipped" for model in baselines]
        left = [model for model, key in zip(baselines, keys) if figures[key + ".lo"] <= 0.0]
        lines.append([f"{time / 1000:g} s", *(interval(figures, key, 3) for key in keys), "yes" if not left else "not than " + ", ".join(f"`{model}`" for model in left)])
    return ["\nNegative log likelihood above that of `shipped`, paired (above 0: `shipped` is better):\n",
            table(["", *(f"`{model}`" for model in baselines), "`shipped` is better with intervals that exclude 0"], lines)]


def forecast_section(figures, name):
    head = f"forecast.{name}."
    text = [f"## Forecasts `{name}`\n",
            f"{figures[head + 'num_encounters']} encounters, {figures[head + 'num_failed']} could not be played; {figures[head + 'num_forecasts']} forecasts, "
            f"{figures[head + 'num_acting']} of them of road users that act. Means over encounters."]
    models = [model for model in MODELS if f"{head}all.nll.{TIMES[0]}ms.{model}" in figures]
    for group, words in GROUPS:
        lines = []
        for score, what, factor in SCORES:
            for time in TIMES:
                keys = [f"{head}{group}.{score}.{time}ms.{model}" for model in models]
                if all(key in figures for key in keys):
                    lines.append([f"{what}, {time / 1000:g} s", *(f"{factor * figures[key]:.{3 if factor == 1.0 else 1}f}" for key in keys)])
        if lines:
            text += [f"\n{words}:\n", table(["", *(f"`{model}`" for model in models)], lines), *above_shipped(figures, f"{head}{group}.nll.", models)]
    families = sorted({key[len(head):].split(".")[0] for key in figures if key.startswith(head) and ".nll.2000ms." in key} - {group for group, _ in GROUPS})
    families = [family for family in families if f"{head}{family}.nll.2000ms.shipped" in figures]
    if families:
        text += ["\nNegative log likelihood after 2 s of those that act, by family:\n",
                 table(["family", *(f"`{model}`" for model in models)],
                       [[family.removesuffix("_acting"), *(f"{figures[f'{head}{family}.nll.2000ms.{model}']:.3f}" for model in models)] for family in families])]
    return "\n".join(text)


CONFIDENCES = (("above_0.9", "above 0.9"), ("0.7_to_0.9", "0.7 to 0.9"), ("below_0.7", "up to 0.7"))
RECALLED = (("in_truth", "as good as the best in truth"), ("as_told", "as was expected there"), ("random_one", "policy of any case"), ("braking", "braking"))


def memory_section(figures):
    text = ["## What memory recalls\n", f"{figures['memory.transfer.cases']:,} cases. In per cent, with exact 95 % intervals."]
    for place, words in (("memory.transfer.within", "Each held against all others"), ("memory.transfer.check", "Other cases held against them")):
        if place + ".queries" not in figures:
            continue
        lines = [[name, percent(figures, f"{place}.{key}.coverage"), *(interval(figures, f"{place}.{key}.{what}", 1, 100.0) for what, _ in RECALLED)]
                 for key, name in CONFIDENCES]
        text += [f"\n{words}, {figures[place + '.queries']:,} scenes in which the choice matters:\n",
                 table(["confidence", "coverage", *(name for _, name in RECALLED)], lines)]
    return "\n".join(text)


CHOICES = (("model_at_once", "the model, at once"), ("model", "the model, after reasoning"), ("model_within", "the same, within the admissible"),
           ("mildest_within", "the mildest of the admissible: nothing first, then AEB, as the arbiter does"), ("forecast", "the best forecast"),
           ("rule_within", "AEB where it is admissible, else the mildest"), ("table_within", "with cues the least by their table"), ("aeb", "AEB always"),
           ("expert", "what the examples teach, knowing the draws"), ("best_within", "the best of the admissible in hindsight"))


def replies_section(figures):
    lines = [[words, *(interval(figures, f"eval.{key}.{what}", 1, 100.0) for what in ("best_within", "admissible")),
              *(interval(figures, f"eval.{key}.{what}") for what in ("regret", "above_rule"))] for key, words in CHOICES if f"eval.{key}.harm" in figures]
    share = lambda key: percent(figures, "eval." + key)
    return "\n".join([
        "## A language model asked about crash cases\n",
        f"{figures['eval.num_examples']} prompts, of {figures['eval.num_known']} of which the harm of every policy is known; {figures['eval.num_failed']} failed.\n",
        table(["choice", "best of the admissible, %", "admissible, %", "regret", "harm above the rule's (AEB, else the mildest), paired"], lines),
        f"\nReplies: {share('ended')} % end by themselves, with {figures['eval.tokens.p50']} tokens (median; at most {figures['eval.tokens.max']}); in "
        f"{share('text_and_answer_agree')} % the text ends with what is then answered. {share('true_statements')} % of the statements that can be checked "
        f"({figures['eval.statements_checked']:.1f} a reply) are true, in {share('true_replies')} % of the replies all are; {share('unfounded')} % of the choices rest "
        f"on a false one. As the reason {share('shown')} % are shown as they are, {share('shown_in_part')} % without what does not hold"
        + (f"; where it may try three times, {share('shown_at_last')} % in all" if "eval.shown_at_last" in figures else "") + ". In twins in which nothing "
        f"has to be done it intervenes in {interval(figures, 'eval.twins.needless', 1, 100.0)} %."
        + (f" Temperature that fits best: {figures['eval.temperature']:.2f}." if "eval.temperature" in figures else "")])


def section(figures):
    sections = []
    for kind, make in (("suite", suite_section), ("ladder", ladder_section), ("forecast", forecast_section)):
        for name in sorted({key.split(".")[1] for key in figures if key.startswith(kind + ".")}):
            sections.append(make(figures, name))
    for key, make in (("tables.", tables_section), ("memory.transfer.", memory_section), ("eval.num_examples", replies_section)):
        if any(known.startswith(key) for known in figures):
            sections.append(make(figures))
    seed = f"seed {figures['meta.seed']}, " if "meta.seed" in figures else ""
    made = (f"\n`{figures['meta.command']}`; {seed}commit {figures['meta.commit']}, {figures['meta.date']}, "
            f"{figures['meta.processor']}" + "".join(f", {part}: {figures['meta.' + part]}" for part in ("memory", "model") if "meta." + part in figures) + ".")
    return "\n".join([*sections, made])


def page_of(runs):
    head = ("# Suites, ladders, forecasts, tables, recalls and replies\n\nMade by `tools/suite_results.py` from [suites.json](suites.json), which holds what the commands "
            "below printed: no figure here is typed by hand. What the words mean: docs/formats.md, section Suite. `regret` is the harm above that "
            "of the best plan begun at T1 with full knowledge; materially worse means by more than 0.005. Rows of `rss_steering` and `fsm` that were made "
            "before commit 5e3d1f80 are of rules that did less than their sources say (decisions/0038).\n\n")
    named = [Figures(run, f"docs/suites.json, `{run.get('meta.command')}`") for run in runs]
    return head + "\n\n".join(section(one) for one in named) + "\n"


def groups_of(words):
    groups = [[]]
    for word in words:
        groups.append([]) if word == "--" else groups[-1].append(word)
    return groups


def with_added(kept, added):
    """The runs that are kept, and those that are added, in the places of those of the same commands."""
    places = {run["meta.command"]: run for run in kept}
    return list((places | {run["meta.command"]: run for run in added}).values())


def main():
    words = sys.argv[1:]
    adds = words[:1] == ["add"]
    groups = groups_of(words[1:] if adds else words) if words else []
    if any(len(group) < 2 for group in groups):  # a commit by itself is no run
        wants_help = words in (["--help"], ["-h"])
        print(__doc__.split("\n\n")[1], file=sys.stdout if wants_help else sys.stderr)
        sys.exit(0 if wants_help else 2)
    runs = [run for commit, *files in groups for run in merged(commit, files)]
    if not groups:
        runs = read_json(KEPT)
    elif adds:
        runs = with_added(read_json(KEPT), runs)
    kept = json.dumps(runs, indent=0, sort_keys=True) + "\n"
    page = page_of(json.loads(kept))
    if groups:
        write_whole(KEPT, kept.encode())
    write_whole(PAGE, page.encode())


if __name__ == "__main__":
    main()
