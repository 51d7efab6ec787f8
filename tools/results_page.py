#!/usr/bin/env python3
"""Makes docs/results.md from docs/results.json, which holds what the runs of tools/bench.sh printed.

usage: tools/results_page.py [FILE.json...]
FILEs are runs as tools/bench.sh leaves them: they take the places of the runs of the same names. Of each run only the figures
that the page shows are kept. Without FILEs the page is made of what is there.
"""

import json
import re
import sys

from figures import ROOT, Figures, flat, interval, read_figures, read_json, table, write_whole

KEPT = ROOT / "docs" / "results.json"
PAGE = ROOT / "docs" / "results.md"
POLICIES = ("AEB", "AES-L", "AES-R", "ES-B-L", "ES-B-R", "T-D-L", "T-D-R", "NI")
ACTORS = (1, 8, 32)


def number(figures, key, digits=2, factor=1.0):
    return f"{factor * figures[key]:,.{digits}f}"


def numbers(figures, keys, digits=2, factor=1.0, between=" / "):
    return between.join(number(figures, key, digits, factor) for key in keys)


def percentiles(figures, name, after="", digits=1, factor=1.0, which=("p50", "p99")):
    return numbers(figures, [f"{name}.{one}{after}" for one in which], digits, factor)


def parts(figures, pattern):
    """What the groups of a pattern are in those names of figures that it fits, each once, numbers in their order."""
    matches = [match for match in map(re.compile(pattern).fullmatch, figures) if match]
    figures.read.update(match.string for match in matches)  # what lines a table has is seen again on what is kept
    found = {match.groups() for match in matches}
    if not found:
        sys.exit(f"{figures.where}: want figures like {pattern!r}, got none")
    return sorted(found, key=lambda groups: [[(float(part), "") if index % 2 else (0.0, part) for index, part in
                                              enumerate(re.split(r"(\d+(?:\.\d+)?)", group))] for group in groups])


def among(figures, head, key):
    """The beginnings of the names of a list's members, by what their `key` is: {"AEB": "policies.0."}."""
    return {figures[f"{head}.{index}.{key}"]: f"{head}.{index}." for (index,) in parts(figures, re.escape(head) + r"\.(\d+)\." + key)}


def of_runs(*runs):
    """Where figures come from, in one sentence for each place and day."""
    origins = {}
    for one in runs:
        machine = f"commit {one['meta.commit']}, {one['meta.date']}, {one['meta.processor']}, {one['meta.cores']} cores"
        origins.setdefault(machine, []).append(f"`{one['meta.command']}`")
    return "\n" + " ".join(f"{', '.join(commands)}: {machine}." for machine, commands in origins.items())


def start_section(runs):
    start = runs["start"]
    return [f"A second start takes {number(start, 'run.start_s', 1)} s until the encounter begins. Memory then: "
            f"{number(start, 'run.saca_rss_mib', 0)} MiB, and {number(start, 'run.model_rss_mib', 0)} MiB of the model's process. docs/testing.md "
            "has what setting up, building and testing take.", of_runs(start)]


def physics_section(runs):
    figures = runs["physics"]
    names = [name for name, in parts(figures, r"(physics\..+)\.low")]
    lines = []
    for name in names:
        reference = number(figures, name + ".reference") if name + ".reference" in figures else "-"
        lines.append([f"`{name}`", number(figures, name), reference, numbers(figures, [name + ".low", name + ".high"], between=" to ")])
    outside = figures["physics.outside_band"]
    off = {what: [figures[name] / figures[name + ".reference"] - 1.0 for name in names if what in name] for what in ("lane_change", "sideways_m")}
    slow, short = (sorted(off[what]) for what in ("lane_change", "sideways_m"))
    return [f"Deterministic. Of {len(names)} figures {len(names) - outside} lie in their bands. `aeb` is the deployed anti-lock brake, `aeb_ideal` "
            "the ideal one. References: docs/architecture.md.", "",
            table(["figure", "ours", "reference", "band"], lines), "",
            f"Lane changes take {100 * slow[0]:.0f} to {100 * slow[-1]:.0f} % longer than the reference, which was optimised offline with the inputs "
            "free; ours are closed loop.", "",
            f"A drift goes {-100 * short[-1]:.0f} to {-100 * short[0]:.0f} % less to the side than the reference: one law for all speeds, tuned to "
            "end across the lane, where the reference's inputs were optimised for each.", of_runs(figures)]


def drift_section(runs):
    figures = runs["physics"]
    cars = sorted({car for car, in parts(figures, r"t_drift\.within_10_deg\.share\.([a-z_]+)\.v.+")})
    speeds = [speed for speed, in parts(figures, r"t_drift\.within_10_deg\.share\.[a-z_]+\.v(\d+)\..+")]
    grips = [grip for grip, in parts(figures, r"t_drift\.within_10_deg\.share\..+\.mu(.+)")]
    share = "t_drift.within_10_deg.share"

    def cell(at):
        if "t_drift.refused" + at in figures and figures["t_drift.refused" + at]:
            return "refused"
        return (f"{number(figures, share + at, 1, 100)} "
                f"({numbers(figures, [f't_drift.within_10_deg.{end}{at}' for end in ('low', 'high')], 0, 100, '-')}) / "
                f"{number(figures, 't_drift.forward_m.p50' + at, 1)} / {number(figures, 't_drift.sideways_m.p50' + at, 1)}")

    lines = [[car, grip, *(cell(f".{car}.v{speed}.mu{grip}") for speed in speeds)] for car in cars for grip in grips]
    worst = min(figures[key] for key in figures if key.startswith(share))
    return [f"Deterministic. Policy 5, straight road, {figures['t_drift.n']} draws each (seed {figures['t_drift.seed']}) of what the controller does "
            "not know (grip, mass, yaw inertia, tyre stiffness, lags, speed). Share within 10 deg of across the lane in % (95 % interval) / forward "
            "travel, median, m / sideways travel, median, m. *refused*: outside the car's domain, said beforehand.", "",
            table(["car", "grip", *(f"{speed} m/s" for speed in speeds)], lines), "",
            f"The worst share of all allowed is {100 * worst:.1f} %. Roll-over is not modelled: wheels lift, bodies do not tip. The SUV's and the "
            "van's static stability factors are above what their tyres hold sliding, kerbs and soft ground aside.", of_runs(figures)]


def choice_section(runs):
    suites = {name: runs["balance_" + name] for name in ("balanced", "natural")}

    def share(name, key):
        return interval(suites[name], f"balance.{name}.{key}", 1, 100.0)

    policies = [[f"{index} {policy}", *(cell for name in suites for cell in
                                        (share(name, f"strict_share.p{index}"), number(suites[name], f"balance.{name}.margin.p{index}", 4),
                                         share(name, f"best_share.p{index}").split(" ")[0]))] for index, policy in enumerate(POLICIES)]
    lessons = [[words, *(share(name, key + "_share") for name in suites)] for words, key in (
        ("the trigger never fires", "never_triggers"), ("doing nothing harms nobody", "nothing_needed"),
        ("nothing does less harm than doing nothing", "nothing_helps"), ("several are as good", "several_as_good"),
        ("one alone is best, and doing nothing harms", "one_alone"))]
    counts = ", ".join(f"{suites[name]['balance.' + name + '.n']} of `{name}`" for name in suites)
    heads = [f"{what}, `{name}`" for name in suites for what in ("strictly best, %", "median margin", "best, ties to the milder, %")]
    return ["Deterministic. All eight policies tried once at the trigger, the others' motion known, in the first encounters of the tuning split: "
            f"{counts}. *Strictly best*: a lower class of harm than every other. 95 % intervals. `natural` weighs families by fatal crashes, "
            "`balanced` is a mixture in which the choice matters (decisions/0012).", "",
            table(["policy", *heads], policies), "", table(["lesson", "`balanced`, %", "`natural`, %"], lessons), "",
            "T1 is late: before a standing obstacle braking is enough up to the speed 2 T1 x grip x g, less what the brakes need to build up; "
            "against who moves towards us, sooner never. Where several are as good the milder is taken, which is why ES-B counts more than AES. "
            "\"Nothing helps\" is rare because braking takes speed off nearly everything.", of_runs(*suites.values())]


def risks_of(record):
    """Of everybody in the last preview of a run."""
    last = parts(record, r"previews\.(\d+)\.actors\.0\.id")[-1][0]
    return ", ".join(f"{number(record, place + 'risk')} for {who}" for who, place in among(record, f"previews.{last}.actors", "id").items())


SCENES = (("oracle_t1", "`intersection_t1` as printed"), ("oracle_t1_trigger", "`intersection_t1` at SACA's own trigger"),
          ("oracle_late_truck", "`intersection_late_truck`"), ("oracle_one_way", "`one_way` as printed"), ("oracle_follower", "`lead_brakes_follower`"))


def scenes_section(runs):
    harms, written = [], []
    for run, words in SCENES:
        figures = runs[run]
        place = {policy: f"policies.{policy}." for policy in range(len(POLICIES))}
        best, second = figures["ranking.0"], figures["ranking.1"]
        shown = list(dict.fromkeys((best, second, 0)))
        told = [", ".join(f"{POLICIES[policy]} {number(figures, place[policy] + key, digits)}" for policy in shown)
                for key, digits in (("harm.mean", 4), ("collision_loss.mean", 2))]
        harms.append([words, number(figures, "time_s"), POLICIES[best], *told])
        written.append([words, *(figures[f"{place[policy]}as_written.text"] if f"{place[policy]}as_written.text" in figures else "refused"
                                 for policy in (0, 3, 4, 5, 6))])
    one_way = runs["run_one_way"]
    return [f"Deterministic; {runs['oracle_t1']['draws']} draws each of what nobody knows, seed {runs['oracle_t1']['seed']}; expected harm and "
            "Collision Loss of the best policy, the next and AEB.", "",
            table(["scene", "begun at, s", "best", "expected harm", "Collision Loss"], harms), "",
            "The same with nothing left to chance:", "",
            table(["scene", *(POLICIES[policy] for policy in (0, 3, 4, 5, 6))], written), "",
            "![Which policy is best at the printed T1, over the distance of the truck and the speed of the ego](whatif_intersection.svg)", "",
            "The map is of `saca whatif intersection_t1 --at-s 5 --vary truck.distance_m=10:24:0.5 --vary ego.speed_mps=8:18:0.5`: nearer or faster "
            "than printed the drift to the right of the paper is best.", "",
            "*Follower*: as in the paper's Fig. 5, policy 4 is right: braking is run into from behind. *Late truck*: harm and the paper's loss "
            "weigh an impact differently: near a corner it moves the occupants less than through the middle of the rear.", "",
            f"Risk in the one-way scene, predicted for the trigger: R = {risks_of(one_way)} (the paper has 0.78 for the obstacle ahead, 0.47 for the "
            "other; where that one stands is our assumption).", of_runs(*(runs[run] for run, _ in SCENES), one_way)]


EMERGENCIES = (("run_9018", "near-crash"), ("run_8911", "near-crash"), ("run_8676", "crash"), ("run_t1", ""), ("run_t2", ""))


def emergencies_section(runs):
    lines = []
    for run, kind in EMERGENCIES:
        figures = runs[run]
        driver = figures["driver.text"] if "driver.text" in figures else "-"
        decided = figures["decision.name"] if "decision.name" in figures else "never triggers"
        best = figures["best"]
        lines.append([f"`{figures['scenario.name']}` {kind}".strip(), driver, f"{decided}, {figures['result.text']}", "-" if best is None else POLICIES[best],
                      "-" if best is None else figures[f"hindsight.{best}.text"]])
    return ["Deterministic: no memory, no language model.", "",
            table(["scenario", "the driver", "SACA", "best in hindsight", "which then"], lines), "",
            "The near-crashes compare SACA at T1 with a driver who was looking elsewhere; they say nothing about false triggers. What is near in "
            "the end is mostly the follower, which reacts and stops behind (decisions/0010). Hindsight watches it for longer. "
            "[suites.md](suites.md) has all events of the study.",
            of_runs(*(runs[run] for run, _ in EMERGENCIES))]


def traffic_section(runs):
    figures = runs["traffic"]
    lines = []
    for name, place in [(source, f"traffic.{source}.") for source, in parts(figures, r"traffic\.([^.]+)\.drives")] + [("all", "traffic.")]:
        lines.append([name, number(figures, place + "drives", 0), number(figures, place + "exposure_h", 3), number(figures, place + "exposure_km"),
                      *(number(figures, place + what, 0) for what in ("previews", "triggers", "false_triggers")),
                      interval(figures, f"{place}false_triggers_per_hour", 1),
                      *(number(figures, place + what, 0) for what in ("interventions", "early_interventions", "false_interventions")),
                      interval(figures, f"{place}false_interventions_per_hour", 1), interval(figures, f"{place}false_interventions_per_1000km", 0)])
    return ["Deterministic; perception is exact and SACA never drives; exact 95 % intervals. CommonRoad's files of US-101 and Lankershim, each "
            "instant of a car once, and those events of the 100-Car study that are rebuilt with more than 1 s before their conflict. "
            f"{figures['traffic.left_out']} drives are left out, nearly all because the track is too short to be smoothed with samples on both sides.", "",
            table(["source", "drives", "h", "km", "previews", "triggers", "false", "false per h", "SACA acts", "before T1", "false", "false per h",
                   "false per 1,000 km"], lines), "",
            "A trigger is a conflict that comes within T1, where full braking at T1 would act; SACA acts by what it expects, or not at all. This is "
            "far too often for a road, and so few hours say no more than the order of magnitude. Nearly all false triggers are one kind: a "
            "neighbour who changes lanes, sways in its lane or turns beside the ego is carried on along the arc that it drives at that moment, into "
            "the ego; nobody needed to brake (decisions/0020). Rates are rather too high than too low: errors of the recording (a track that ends, "
            "bodies that touch) count as false, and so do conflicts that hold already at the first look of a short drive. Of the 100-Car study only "
            "the conflict's own lead and follower are known, not the lanes beside: its rate is that of car following alone.",
            of_runs(figures)]


CLASSES = ("M", "LC", "RC", "FB", "LB", "RB")
SITES = (("100car", "100-Car"), ("lankershim", "Lankershim"), ("us101", "US-101"), ("all", "all"))


def bounded(figures, name, digits=3):
    return f"{number(figures, name + '.value', digits)} [{numbers(figures, [name + '.low', name + '.high'], digits, between=', ')}]"


def intentions_section(runs):
    figures = runs["intent_eval"]
    titles = among(figures, "comparisons", "title")
    recorded, simulated, lankershim, us101 = (next(place for title, place in titles.items() if title.startswith(words)) for words in
                                              ("Recorded", "Simulated", "Transfer: lankershim", "Transfer: us101"))
    methods = among(figures, recorded + "methods", "method")
    lines = []
    for method, place in methods.items():
        lines.append([method, bounded(figures, place + "heads.0.macro_f1"), *(number(figures, f"{place}heads.{head}.macro_f1.value", 3) for head in (1, 2)),
                      number(figures, place + "heads.0.calibration_error", 3),
                      numbers(figures, [f"{place}heads.{head}.log_loss" for head in (0, 1, 2)], 3, between=", "),
                      number(figures, place + "warning_before_line.median_s", 1), number(figures, place + "false_alarms_per_hour", 0),
                      number(figures, place + "illegal_steps", 0),
                      bounded(figures, place + "ours_less_this") if place + "ours_less_this.value" in figures else "-"])
    ours = methods["LSTM-CRF"]
    found = [[name, f"{figures[f'{ours}acts.{name}.found']} of {figures[f'{ours}acts.{name}.acts']}",
              *(number(figures, f"{ours}acts.{name}.recall_by_age.{age}.recall") for age in range(5))] for name in ("LC", "RC", "FB")]
    confusion = [[name, *(number(figures, f"{ours}heads.0.confusion.{row}.{column}", 0) for column in range(len(CLASSES))),
                  *(number(figures, f"{ours}heads.0.classes.{name}.{what}") for what in ("recall", "f1"))] for row, name in enumerate(CLASSES)]
    transfer = []
    for site, words in ((lankershim, "Lankershim, streets with signals"), (us101, "US-101, motorway")):
        known = among(figures, site + "methods", "method")
        transfer.append([words, *(numbers(figures, [f"{known[seen]}heads.{head}.macro_f1.value" for head in (0, 1, 2)], 3, between=", ")
                                  for seen in ("its site seen", "its site never seen")), bounded(figures, known["its site never seen"] + "ours_less_this")])
    tells = simulated + "methods.0."
    return ["Deterministic. Sequences: NGSIM in CommonRoad's files and the 100-Car study ([traffic.md](traffic.md)), labelled as "
            "[intention.md](intention.md) says. Each fifth by a model that has not seen its vehicles; 95 % intervals by drawing the groups anew. "
            f"{number(figures, ours + 'hours', 1)} vehicle-hours, {number(figures, ours + 'warning_before_line.events', 0)} lines crossed, "
            f"{number(figures, ours + 'warning_before_braking.events', 0)} brakings.", "",
            table(["recorded vehicles: M, LC, RC, FB", "macro F1 now", "0.5 s ahead", "1 s ahead", "calibration error", "log loss now, 0.5, 1 s",
                   "before the line, median, s",
                   "false alarms per vehicle-hour", "illegal steps", "LSTM-CRF less this, macro F1 now"], lines), "",
            "Aims: 0.85 now, 0.75 at 0.5 s, calibration error 0.03, 1.0 s before the line, no illegal steps (what is named is judged for "
            "each frame by itself; the likeliest path of the chain takes none). The rule is that of the labels as the motion comes in.", "",
            "Gradient-boosted trees on the same windows find acts sooner and have a higher macro F1, with more false alarms; the LSTM without its chain "
            "has a little more of both (decisions/0015; `tools/intention.sh` measures both).", "",
            "![Who was what, and what was predicted](intention/confusion.svg)", "",
            table(["now", "acts found", "recall of their frames: first 0.3 s", "to 0.6 s", "to 1 s", "to 2 s", "later"], found), "",
            "Labels know the end of an act at its first frame, a stream does not: what is missed are mostly the first 0.6 s.", "",
            "![A lane change, by a model that has not seen it](intention/lane_change.svg)", "![Two brakings and a stop](intention/braking.svg)", "",
            table(["now: truth in rows", *CLASSES, "recall", "F1"], confusion), "",
            table(["transfer, macro F1 now, 0.5, 1 s", "site seen in training", "never seen", "loss now"], transfer), "",
            "Aim: a loss of at most 0.08. Simulated vehicles that no model has seen, macro F1 of LB and RB: "
            f"{numbers(figures, [f'{tells}heads.{head}.macro_f1.value' for head in (0, 1, 2)], 3, between=', ')}. They are easier than the road.",
            "", *displacements(figures), *motion(runs["intent_motion"]),
            of_runs(figures, runs["intent_motion"])]


FORESIGHTS = (("constant velocity", "constant velocity"), ("lane keeping", "straight along the lane"),
              ("likeliest intention", "motion under the likeliest intention"), ("mean over intentions", "mean over the intentions"))


def displacements(figures):
    places = {}
    for index, in parts(figures, r"displacements\.(\d+)\.mean_m"):
        head = f"displacements.{index}."
        places[figures[head + "vehicles"], figures[head + "foresight"], figures[head + "ahead_s"]] = head
    counts = [number(figures, places[which, FORESIGHTS[0][0], 1] + "frames", 0) for which in ("all", "acting")]
    lines = [[words, *(numbers(figures, [places[which, name, ahead] + "mean_m" for ahead in (1, 2, 3)], between=", ") for which in ("all", "acting"))]
             for name, words in FORESIGHTS]
    return [table(["mean displacement error after 1, 2, 3 s [m]", f"all vehicles in lanes ({counts[0]} frames)",
                   f"those that brake or change lanes ({counts[1]} frames)"], lines), ""]


def motion(figures):
    def spread(site, name, digits):
        place = f"sites.{site}.{name}."
        return f"{number(figures, place + 'median', digits)} ({number(figures, place + 'log_sd')})"

    lines = [[f"{words} ({number(figures, f'sites.{site}.braking_mps2.num', 0)} brakings, {number(figures, f'sites.{site}.lane_change_s.num', 0)} lane changes)",
              spread(site, "braking_mps2", 2), spread(site, "rise_s", 1), spread(site, "held", 2), spread(site, "lane_change_s", 1),
              f"{number(figures, f'sites.{site}.acceleration_sd_mps2')} over {number(figures, f'sites.{site}.acceleration_time_s', 1)}"] for site, words in SITES]
    return ["How people brake, change lanes and waver: median, and in brackets the standard deviation of the logarithm. `intent::MotionLaw` has the "
            "numbers of `all`; previews go on assuming hard braking and quick lane changes (`preview/caution.h`, decisions/0015).", "",
            table(["", "braking [m/s2]", "its rise [s]", "1 s later, over now", "a lane of 3.5 m [s]", "acceleration of those who maintain [m/s2, s]"], lines)]


def model_section(runs):
    figures, process = runs["model_bench"], runs["model_process"]
    times = [(words, percentiles(figures, "reason." + name, digits=2) + " s", aim) for words, name, aim in (
        ("first answer, one forecast, p50 / p99", "first_answer_s", "0.8 s"), ("full answer, one forecast, p50 / p99", "full_answer_s", "1.5 s"),
        ("first answers of three forecasts, p50 / p99", "three_first_answers_s", ""),
        ("three forecasts (deadline 4.2 s), p50 / p99", "three_previews_s", "3.5 s"))]
    lines = [("load, with the system part evaluated", number(figures, "reason.load_s") + " s", ""),
             ("prompt / system part", numbers(figures, ["reason.prompt_tokens", "reason.system_tokens"], 0) + " tokens", "450"), *times,
             (f"asks with an answer missing, or returned late, of {number(figures, 'reason.full_answer_s.n', 0)}",
              numbers(figures, ["reason.deadline_misses", "reason.returned_after_deadline"], 0, between=", "), "0"),
             ("prompt / reply / three replies together",
              numbers(figures, [f"reason.{what}_tokens_per_s" for what in ("prompt", "reply", "three_reply")], 0) + " tokens/s", ""),
             ("answers and the way between the processes, of one question", number(figures, "reason.answers_and_process_s", 0, 1000) + " ms", ""),
             ("replies of three that do not end by themselves", number(figures, "reason.forced_share", 0, 100) + " %", ""),
             ("memory of the model's process", number(figures, "reason.child_resident_mib", 0) + " MiB", "")]
    ways = [[f"{tokens} tokens of reasoning", *(number(process, f"{where}/{tokens}/real_time.real_time_us", 0, 1e-3)
                                                for where in ("in_this_process", "in_a_child_process"))] for tokens in (0, 80)]
    tuned = "" if figures["meta.model"].startswith("saca-") else "not "  # as `make model` calls what it made of the adapter
    return [f"{figures['meta.model']}, {tuned}fine-tuned. `saca model score` measures how well it chooses, in closed loop; docs/model-protocol.md says "
            "how it is asked.", "",
            table(["figure", "value", "aim"], lines), "",
            "What a process of its own costs:", "",
            table(["one question, ms", "in the asking process", "in a process of its own"], ways), of_runs(figures, process)]


def decide_section(runs):
    figures, vehicle = runs["bench_decide"], runs["bench_vehicle"]
    every = ("p50", "p99", "p99.9", "max")
    lines = []
    for actors in ACTORS:
        for follows in ("", ".followed"):
            after = f".actors{actors}{follows}"
            lines.append([f"{actors}{', one follows' if follows else ''}", percentiles(figures, "decide.reflex_us", ".fresh" + after, 1, which=every),
                          percentiles(figures, "decide.reflex_us", after, 1, which=every),
                          number(figures, "decide.reflex_us.judged_share" + after, 0, 100) + " %",
                          percentiles(figures, "decide.machine_us", after, 1, which=every), percentiles(figures, "decide.atlas_judge_us", after, 0),
                          percentiles(figures, "decide.verdict_us", after, 1, 1e-3)])
    steps, verdicts = ([figures[f"decide.{what}.n{after}"] for after, in parts(figures, rf"decide\.{what}\.n(\..+)")] for what in ("reflex_us", "verdict_us"))
    return [f"{min(steps):,} to {max(steps):,} steps of the reflex plane and {min(verdicts):,} to {max(verdicts):,} verdicts for each number of "
            "others, as many as 4 s have room for. A share of the scenes triggers; six plans are received and matched. Where a fresh verdict is "
            "there the step decides by it, else by the atlas. *Machine* is a loop of the same median length that only reads the clock: what is "
            "above its median is the machine's doing, not the program's; the thread has no priority of its own. A step allocates nothing, by test.", "",
            table(["others", "step with a fresh verdict, us, p50 / p99 / p99.9 / max", "step without, us, likewise",
                   "of these judged by the atlas", "machine, us, likewise",
                   "the atlas' judgement alone, us, p50 / p99", "a verdict, ms, p50 / p99"], lines), "",
            "Aims: 50 us for a step at p99.9 with 8 others, 20 verdicts a second. A follower's reaction to every plan is simulated, which costs "
            "most of the time where somebody follows.", "",
            f"The vehicle model with its controller and brakes takes {number(vehicle, 'vehicle.steps_per_s', 0)} steps of 1 ms per second: a rollout "
            f"of 2.5 s takes {2500 / vehicle['vehicle.steps_per_s'] * 1000:.1f} ms (aim 1.5).", of_runs(figures, vehicle)]


def parts_section(runs):
    batch, outcome, perception, intent, memory = (runs[name] for name in ("batch", "outcome", "perception", "intent", "memory"))

    def scenes(name):
        if name + ".error" in batch:
            return "not on this processor" if batch[name + ".error"] else "-"
        return number(batch, name + ".items_per_second", 0)

    levels = [[words, scenes(f"batch_scenes/{level}"), scenes(f"batch_scenes_in_a_row/{level}")]
              for level, words in enumerate(("baseline (SSE2)", "AVX2 with FMA", "AVX-512"))]
    lines = [(words, numbers(figures, [name + ".cpu_time_us" for name in names], digits)) for words, figures, names, digits in (
        ("one outcome: past 8 actors / contact among 8 / with what follows / slide to rest", outcome,
         ("judge_past_8_actors", "judge_contact_among_8_actors", "judge_contact_and_aftermath", "slide_to_rest"), 0),
        ("perception, everything on, 8 / 32 actors", perception, ("look/8", "look/32"), 1),
        ("intentions of 64 vehicles, one core", intent, ("sixty_four_vehicles/1",), 0),
        ("similarity of two scenes with 1 / 8 / 32 actors", memory, [f"similarity_to_own_forecast/{actors}" for actors in ACTORS], 1),
        ("nearest of 1,000 / 30,000 cases", memory, ("nearest_of/1000", "nearest_of/30000"), 0))]
    return ["The batch: a scene is eight policies driven to rest or a recovered lane, no intervention for 5 s. Judging is not in it.", "",
            table(["level", "scenes/s/core", "with memory used again"],
                  [["scalar `drive`, RK4 at 1 ms", number(batch, "scalar_scenes.items_per_second", 0), "-"], *levels]), "",
            "Aim: 5,000. Steps are 5 ms while nothing brakes, 3.3 ms in plans that brake, 2.5 ms in a T-drift.", "",
            table(["computing time", "us"], lines), of_runs(batch, outcome, perception, intent, memory)]


def atlas_section(runs):
    info, check, bench = (runs[name] for name in ("atlas_info", "atlas_check", "bench_atlas"))
    speeds = [[f"{actors}", *(percentiles(bench, "atlas.futures_us", f".actors{actors}{after}", 0)
                              for after in ("", ".spread", ".targets4", ".spread.targets4"))] for actors in ACTORS]
    edges = [low for low, in parts(check, r"atlas\.chance_from_(.+)\.plans")]
    chances = [[f"{low} to {high}", number(check, f"atlas.chance_from_{low}.told", 3), number(check, f"atlas.chance_from_{low}.plans", 0),
                interval(check, f"atlas.chance_from_{low}.touched", 2, 100)] for low, high in zip(edges, [*edges[1:], "1"])]
    shares = [[words, interval(check, f"atlas.{name}", 2, 100)] for words, name in (
        ("plans within the atlas' bounds", "covered_share"), ("agree on contact", "contact_agreement"), ("on the partner", "partner_agreement"),
        ("on the ego's face", "face_agreement"), ("choosing by the atlas costs nothing", "same_choice_share"))]
    return [f"{info['points']:,} points, {number(info, 'bytes', 1, 1e-6)} MB on disk and mapped. All eight futures, us, p50 / p99 of "
            f"{number(bench, 'atlas.futures_us.n.actors8', 0)} calls, by whether the others are known exactly or with their spread, and by the "
            "target speeds that are tried:", "",
            table(["actors", "exactly, one speed", "with spread, one speed", "exactly, four speeds", "with spread, four speeds"], speeds), "",
            "Aim: 20 us at 8 actors. Tracks of 10 ms.", "",
            f"Against `roll_out` at equal grip (deterministic; calibration seed, seven families): {number(check, 'atlas.scenes', 0)} scenes, "
            f"{number(check, 'atlas.plans', 0)} plans.", "",
            table(["", "% (95 % interval)"], shares), "",
            f"Impact speed is off by {numbers(check, [f'atlas.impact_speed_off_mps.{at}' for at in ('p50', 'p95', 'max')], 3)} m/s (p50 / p95 / "
            f"max), clearance by {number(check, 'atlas.clearance_off_m.p95')} m (p95). Choosing by the atlas costs "
            f"{number(check, 'atlas.regret.mean', 4)} harm on average, p95 {number(check, 'atlas.regret.p95', 3)}: it counts one first contact, "
            f"`roll_out` all. Where nothing is struck twice ({number(check, 'atlas.regret_lone.scenes', 0)} scenes) it is "
            f"{number(check, 'atlas.regret_lone.mean', 4)}.", "",
            "The told chance of contact on a grip known to 6 %, one drive per plan on a drawn grip:", "",
            table(["told", "mean told", "plans", "touched, %"], chances), of_runs(info, check, bench)]


PROBLEMS = (("a wave carried along, upwind", "a_wave_carried_along_upwind"), ("likewise, ENO2", "a_wave_carried_along_eno2"),
            ("likewise, ENO3", "a_wave_carried_along_eno3"), ("likewise, WENO5", "a_wave_carried_along_weno5"),
            ("a disc that grows, WENO5, off the kink", "a_disc_that_grows_weno5"),
            ("a disc that shrinks, likewise", "a_disc_that_shrinks_weno5"), ("braking before a wall, WENO5, running maximum", "braking_before_a_wall_weno5"))


def reach_section(runs):
    check, bench, network = runs["reach_check"], runs["bench_reach"], runs["authors_network"]
    errors = [[words, f"{check[f'reach.check.{name}.error_m']:.1e}", number(check, f"reach.check.{name}.order")] for words, name in PROBLEMS]
    air = []
    for size, in parts(bench, r"reach\.air3d_(.+)\.volume_error"):
        head = f"reach.air3d_{size}."
        threads = [count for count, in parts(bench, re.escape(head) + r"seconds\.t(\d+)")]
        air.append([size, *(f"{100 * bench[head + 'volume_error' + kind]:.5f} %" for kind in ("", ".double")),
                    *(numbers(bench, [f"{head}ns_per_point_stage.t{count}{kind}" for count in threads], 1) for kind in ("", ".double")),
                    number(bench, f"{head}seconds.t{threads[-1]}", 2)])
    lines = [(f"a parked car in four dimensions, {number(bench, 'reach.avoid4d.points', 0)} points, 4 s, grip 0.9, seen from the ego (aim 60 s, 1 GiB)",
              f"{number(bench, 'reach.avoid4d.seconds', 0)} s, {number(bench, 'reach.avoid4d.ns_per_point_stage', 1)} ns per point and stage"),
             (f"its memory, whole process (predicted {number(bench, 'reach.avoid4d.foretold_mib', 0)} MiB)",
              f"{number(bench, 'reach.avoid4d.peak_mib', 0)} MiB, {number(bench, 'reach.avoid4d.bytes_per_point', 0)} bytes per point"),
             ("look-up in a table, p50 / p99 of states drawn at random", percentiles(bench, "reach.lookup_us", digits=2) + " us"),
             ("danger of a meeting that the tables hold, p50 / p99 (aim 0.5)", percentiles(bench, "reach.risk_us", digits=2) + " us"),
             (f"danger of one beyond their ends ({100 * (1 - bench['reach.risk_us.exact_share']):.0f} % of those drawn): 19 evasions are driven",
              percentiles(bench, "reach.risk_beyond_us", "", 2, 1e-3) + " ms"),
             (f"roofline: {number(bench, 'reach.bytes_per_point_stage', 0)} bytes per point and stage, of {number(bench, 'reach.memory_gb_per_s', 0)} GB/s",
              f"{number(bench, 'reach.roofline_share', 0, 100)} %: arithmetic sets the time, not memory")]
    speeds = [speed for speed, in parts(network, r"reach\.authors_net\.false_safe\.speed(.+)")]
    fastest = f"reach.authors_net.false_safe.speed{speeds[-1]}"
    head = "reach.authors_net."
    return ["Against known answers (deterministic; doubles, TVD-RK3; mean error on the finest of four grids, and its order): "
            "[picture](reach/convergence.svg)", "",
            table(["problem", "error, m", "order"], errors), "",
            "air3D: the volume of its tube at 2.8 s against `data/reference/air3d_hj_reachability.json` (`hj_reachability` 0.7.0, JAX 0.10.2), the "
            "same rule for both. No published volume or minimum of this game was found. Times are the quickest of the repeats; aim 8 ns in float on "
            "all threads.", "",
            table(["grid", "volume off by, float", "double", f"float, {' / '.join(threads)} threads, ns per point and stage",
                   "double, likewise", f"float, {threads[-1]} threads, s"], air), "",
            table(["the solver and its tables", ""], lines), "",
            f"The authors' network beside `paper_ellipse`: {number(network, head + 'n', 0)} states of its range, "
            f"{number(network, head + 'n_unsafe', 0)} of them unsafe: same sign {number(network, head + 'sign_agreement', 1, 100)} %, false safe "
            f"{number(network, head + 'false_safe', 1, 100)} % ({number(network, fastest, 1, 100)} % at {speeds[-1]} m/s), false alarms "
            f"{number(network, head + 'false_alarm', 1, 100)} %; {number(network, head + 'n_outside', 0)} states lie outside the solution and are "
            f"left out. Calling everything safe would have the same sign in {100 * (1 - network[head + 'n_unsafe'] / network[head + 'n']):.0f} %. "
            "[reach.md](reach.md) shows both.", of_runs(check, bench, network)]


SECTIONS = (  # title, what makes it, and of which runs
    ("Start", start_section, ["start"]),
    ("Physics", physics_section, ["physics"]),
    ("T-drift, robustness", drift_section, ["physics"]),
    ("Choice", choice_section, ["balance_balanced", "balance_natural"]),
    ("The paper's scenes", scenes_section, [run for run, _ in SCENES] + ["run_one_way"]),
    ("Recorded emergencies", emergencies_section, [run for run, _ in EMERGENCIES]),
    ("Normal driving, in shadow", traffic_section, ["traffic"]),
    ("Intentions", intentions_section, ["intent_eval", "intent_motion"]),
    ("Language model", model_section, ["model_bench", "model_process"]),
    ("Planes", decide_section, ["bench_decide", "bench_vehicle"]),
    ("Parts", parts_section, ["batch", "outcome", "perception", "intent", "memory"]),
    ("Atlas", atlas_section, ["atlas_info", "atlas_check", "bench_atlas"]),
    ("Reachability", reach_section, ["reach_check", "bench_reach", "authors_network"]),
)
HEAD = """# Results

Made by `tools/results_page.py` from [results.json](results.json), which holds what the commands below each section printed: no figure of ours here is typed by hand. `make bench` measures
all of them anew; `tools/bench.sh` is the list of the runs, and says where the programs are and what some of them need that is not in the repository.
Where a section does not say that it is deterministic its figures are times, measured on a machine that others share: compare ratios and percentiles of one run, not times of different days.

Methods in closed loop over many encounters, ladders and forecasts: [suites.md](suites.md). The vehicle model beside those of another group: [outside-models.md](outside-models.md).
Long runs that hold bounds and print no figures for programs: `make soak`.
"""


def page_of(runs):
    text = HEAD
    for title, make, names in SECTIONS:
        missing = [name for name in names if name not in runs]
        lines = [f"Not measured yet: `tools/bench.sh {' '.join(missing)}` does that."] if missing else make(runs)
        text += "\n".join(["", f"## {title}", "", *lines, ""])
    return text


def runs_of(all_runs, where):
    """Figures of each run, by its name."""
    return {run["meta.name"]: Figures(run, f"{where}, run `{run['meta.name']}`") for run in all_runs}


def kept_of(runs):
    """What docs/results.json holds after the page was made: of each run the figures that it shows, and where they come from; all
    of a run whose section lacks another."""
    names = {name for _, _, wanted in SECTIONS for name in wanted}
    return [{key: value for key, value in run.items() if key in run.read or key.startswith("meta.") or not run.read}
            for name, run in sorted(runs.items()) if name in names]


def main(files):
    runs = runs_of(read_json(KEPT) if KEPT.exists() else [], f"docs/{KEPT.name}")
    for file in files:
        runs |= runs_of([flat(read_figures(file, "meta.name"))], file)
    page = page_of(runs)
    write_whole(KEPT, (json.dumps(kept_of(runs), indent=0, sort_keys=True) + "\n").encode())
    write_whole(PAGE, page.encode())


if __name__ == "__main__":
    main(sys.argv[1:])
