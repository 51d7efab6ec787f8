// Everything that does not move: header, decision, driver, result with hindsight, previews, run.

const policy_cell = (id, name, ...marks) => el("span", { class: "policy" },
  el("b", { text: `${id} ${name ?? ""}` }), ...marks, el("small", { text: policy_words[id] ?? "" }));

const contact_cell = (contact) => (contact
  ? el("span", { class: "hit" }, "✕ ", contact_words(contact)) : el("span", { class: "free", text: "✓ none" }));

const source_words = {
  memory: "from memory", model: "from the language model", arbiter: "by the verdict", fallback: "rule-based fallback",
  forced: "ordered by the user" };
const gate_words = {
  cache: "similar enough: the stored policy is cached as it is", check: "similar: the stored policy must pass a rollout",
  reason: "nothing similar enough: the model is asked" };
const answer_words = { first: "right after the prompt", ended: "reply ended", forced: "cut by the deadline" };

/** " to car1 at 5.40 s", where the record says so. */
function nearest_words({ nearest }) {
  return nearest?.to ? ` to ${nearest.to}${is_number(nearest.time_s) ? ` at ${num(nearest.time_s, 2, "s")}` : ""}` : "";
}

/** The best in hindsight beside what truly came of it: the same only where nothing else was begun and it ended alike. */
function hindsight_words({ decision, switches, result }, best) {
  if (num(best.harm, 3) !== num(result.harm, 3)) return `harm ${num(best.harm, 3)}`;
  return decision && best.policy === decision.policy && !switches.length ? "was carried out" : "with equal harm";
}

/** What a policy's row is marked by, where it was begun at the trigger. */
const begun_words = (record) => (record.switches.length ? "begun first" : "carried out");

function show_header(record) {
  const { scenario, result, decision } = record, contact = result.contact;
  by_id("title").textContent = scenario.title || scenario.name || "Encounter";
  document.title = `${scenario.title || scenario.name || "Encounter"} – SACA`;
  by_id("origin").textContent = scenario.source ? `· ${scenario.source}` : "";
  by_id("sentence").textContent = result.text || "The record holds no result.";
  const best = record.hindsight.find((row) => row.policy === record.best);
  const tile = (name, value, note, kind = "") => el("div", { class: `tile ${kind}` },
    el("span", { class: "tile-name", text: name }), el("b", { class: "tile-value", text: value }), el("small", { text: note }));
  by_id("tiles").append(
    decision ? tile("Decision", decision.name ?? String(decision.policy), [policy_words[decision.policy], source_words[decision.source] ?? decision.source].filter(Boolean).join(", "), "tile-decision")
      : tile("Decision", "none", "nothing was triggered"),
    contact ? tile("Contact", `✕ ${num(contact.relative_speed_mps, 1, "m/s")}`, [contact.with, contact.ego_face].filter(Boolean).join(" · "), "tile-bad")
      : tile("Contact", "✓ none", is_number(result.clearance_m) ? `smallest gap ${num(result.clearance_m, 2, "m")}${nearest_words(result)}` : "nobody came near", "tile-good"),
    tile("Harm", num(result.harm, 3), `Collision Loss ${num(result.collision_loss, 2)}`),
    tile("Best in hindsight", best ? best.name : none, best ? hindsight_words(record, best) : "not judged"));
}

/** What `saca explain` tells, by paragraph; the first is in short. */
const read_explanation = (text) => list(JSON.parse(text)).map(dict);

function explanation_details(paragraphs) {
  if (!paragraphs.length) return [];
  const one = ({ about, sentences }) => [el("h3", { text: about }), el("ul", {}, list(sentences).map((text) => el("li", { text })))];
  return [el("details", { class: "explanation" }, el("summary", { text: "All of it, in words" }), ...paragraphs.flatMap(one))];
}

function show_decision(record) {
  const { decision } = record, panel = by_id("decision");
  const [in_short, ...in_detail] = read_explanation(by_id("explanation").textContent);
  const short_words = list(in_short?.sentences).map((text) => el("p", { class: "in-short", text }));
  if (!decision) {
    panel.append(el("p", { text: "No manoeuvre was triggered in this encounter." }), ...short_words, ...explanation_details(in_detail));
    return;
  }
  const match = is_number(decision.preview) ? `preview ${decision.preview + 1}${is_number(decision.similarity) ? `, ${percent(decision.similarity)} alike` : ""}` : "no preview matched";
  panel.append(
    el("p", { class: "lead" }, el("b", { text: `${decision.policy} ${decision.name ?? ""}` }), ` – ${plan_words(decision.policy, decision)}`),
    el("p", {}, tag(source_words[decision.source] ?? String(decision.source), "strong"), " ", tag(match), " ", tag(`at ${num(decision.time_s, 2, "s")}`)),
    ...(short_words.length ? short_words : [el("p", { text: decision.text || "The record gives no reason." })]), ...explanation_details(in_detail),
    ...verdict_table(decision.verdict, decision, `at T1${decision.by_atlas ? ", by the atlas" : ""}`), ...switch_list(record));
}

/** What was expected of every plan when this one was begun, the least harmful first; nothing where no verdict was used. */
function verdict_table(verdict, { policy, target_speed_mps, strength }, when) {
  const plans = list(verdict?.plans);
  if (!plans.length) return [];
  const driven = plans.filter((plan) => is_number(plan.harm)).sort((a, b) => a.harm - b.harm);
  const most = Math.max(...driven.map((plan) => plan.harm), 1e-9);
  const rows = [...driven, ...plans.filter((plan) => !is_number(plan.harm))].map((plan) => {
    const chosen = plan.policy === policy && plan.target_speed_mps === target_speed_mps && plan.strength === strength;
    const marks = [plan.harm <= verdict.admissible_harm && is_number(plan.harm) ? tag("admissible", "good") : null, chosen ? tag("carried out", "strong") : null];
    return { class: chosen ? "chosen" : is_number(plan.harm) ? "" : "refused", cells: [
      el("span", { class: "policy" }, el("b", { text: plan_name(plan) }), ...marks),
      is_number(plan.harm) ? bar(plan.harm / most, num(plan.harm, 4)) : "cannot be driven", is_number(plan.contact) ? percent(plan.contact) : none] };
  });
  const caption = `Expected of all plans ${when}`;
  return [el("details", {}, el("summary", { text: caption }), table(caption, ["Plan", "Expected harm", "Contact"], rows))];
}

/** What began later in its place, and why. */
function switch_list(record) {
  return record.switches.map((one) => el("p", {}, tag(`at ${num(one.t_s, 2, "s")}`), " ", el("b", { text: plan_name(one) }), ` – ${one.reason}: ${one.text}`));
}

/** What the model wrote when it was over; nothing where there is none. */
function show_review(record) {
  const { review } = record, panel = by_id("review");
  if (!review) {
    panel.remove();
    return;
  }
  panel.append(...reasons(review.explanation, review.text, review.truth),
    el("details", {}, el("summary", { text: "Prompt" }), el("pre", { class: "prompt", tabindex: "0", text: review.prompt })));
}

function show_driver(record) {
  by_id("driver").append(el("p", { text: record.scenario.driver || "The record does not know: this encounter has no recorded driver." }));
}

function show_result(record) {
  const panel = by_id("result"), { result, decision } = record;
  const rows = record.hindsight.map((row) => {
    const marks = [row.policy === record.best ? tag("best", "good") : null, row.policy === decision?.policy ? tag(begun_words(record), "strong") : null];
    const name = policy_cell(row.policy, row.name, ...marks);
    if (row.refusal) return { class: "refused", cells: [name, el("span", { text: `refused: ${row.refusal}` }), none, none, none] };
    return { class: row.policy === decision?.policy ? "chosen" : "", cells: [name, contact_cell(row.contact),
      { class: "n", content: el("span", {}, num(row.clearance_m, 2), el("small", { text: nearest_words(row) })) }, { class: "n", content: num(row.collision_loss, 2) }, { class: "n", content: num(row.harm, 3) }] };
  });
  const hit = result.contact;
  panel.append(el("dl", { class: "facts" }, ...[
    ["Contact", hit ? contact_words(hit) : "none"],
    hit ? ["Face of the other", hit.other_face ?? none] : null,
    hit ? ["Change of speed, ego / other", `${num(hit.ego_delta_v_mps, 1)} / ${num(hit.other_delta_v_mps, 1, "m/s")}`] : null,
    ["Smallest gap", `${num(result.clearance_m, 2, "m")}${nearest_words(result)}`], ["Collision Loss", num(result.collision_loss, 2)], ["Harm", num(result.harm, 3)],
  ].filter(Boolean).map(([k, v]) => el("div", {}, el("dt", { text: k }), el("dd", { text: v })))));
  const pictures = [close_up(record), cost_charts(record)].filter(Boolean);
  if (pictures.length) panel.append(el("div", { class: "pictures" }, pictures));
  panel.append(rows.length
    ? table("Outcome of each policy from the trigger on", ["Policy", "Contact", "Gap [m]", "Collision Loss", "Harm"], rows)
    : el("p", { class: "soft", text: "The record holds no hindsight." }));
}

// --- previews -------------------------------------------------------------------------------------

function posterior_bars(posterior, likeliest) {
  const order = Object.keys(intention_words);
  return el("span", { class: "posterior" }, Object.entries(dict(posterior)).sort(([a], [b]) => order.indexOf(a) - order.indexOf(b)).map(([name, p]) => el("span", {
    class: `intent ${name === likeliest ? "likeliest" : ""}`, title: `${intention_words[name] ?? name}: ${percent(p)}` },
    el("span", { class: "intent-bar", "aria-hidden": "true" }, el("span", { style: { height: `${Math.round(100 * (p || 0))}%` } })),
    el("span", { text: name }), el("span", { class: "hidden", text: percent(p) }))));
}

function preview_actors(preview) {
  const rows = list(preview.actors).map((actor) => ({ cells: [el("b", { text: actor.id }),
    el("span", {}, intention_words[actor.intention] ?? actor.intention ?? none, el("br"), posterior_bars(actor.posterior, actor.intention)),
    el("span", {}, bar(actor.risk, num(actor.risk, 2), actor.risk >= risk_shown ? "danger" : ""), el("small", { text: actor.risk_text ?? "" }))] }));
  return rows.length ? table("Actors, their intentions and risks", ["Actor", "Intention in this preview, and all it may have", "Risk"], rows)
    : el("p", { class: "soft", text: "No actors." });
}

/** Q_h as the room that the best evasion leaves; where none helps, how deep it still runs in. */
function room_words(q) {
  return is_number(q) ? (q < 0 ? num(-q, 1) : `none: hits ${num(q, 1)} deep`) : none;
}

function preview_facts(preview) {
  const rows = list(preview.facts).map((fact) => {
    const chosen = preview.plan && preview.plan.policy === fact.policy;
    const name = policy_cell(fact.policy, fact.name, chosen ? tag("planned", "strong") : null);
    if (fact.refusal) return { class: "refused", cells: [name, `refused: ${fact.refusal}`, none, none, none] };
    return { class: chosen ? "chosen" : "", cells: [name, el("span", { class: fact.contact ? "hit" : "free" }, fact.contact ? "✕ " : "✓ ", fact.text || contact_words(fact.contact)),
      { class: "n", content: num(fact.collision_loss, 2) }, { class: "n", content: num(fact.harm, 3) }, { class: "n", content: room_words(fact.q_m) }] };
  });
  return table("Forecast of each policy", ["Policy", "Forecast", "Loss", "Harm", "Room left after 0.5 s of it, m"], rows);
}

function preview_answers(preview, record) {
  const answers = list(preview.answers);
  if (!answers.length) return el("p", { class: "soft", text: record.model === "off" ? "The model was off." : "The model gave no answer." });
  const name = (p) => list(preview.facts).find((f) => f.policy === p)?.name ?? "";
  const headings = ["Policy", ...answers.map((a) => `${answer_words[a.kind] ?? a.kind}, ${num(a.t_s, 2, "s")}`)];
  const rows = policy_words.map((_, p) => ({ cells: [`${p} ${name(p)}`, ...answers.map((answer) => {
    const chances = list(answer.probability), top = chances[p] === Math.max(...chances);
    return bar(chances[p], percent(chances[p]), top ? "top" : "");
  })] }));
  return table("Probability of each policy over time", headings, rows);
}

const explained_by = { model: "as the language model wrote it; every statement is true", model_in_part: "by the language model, without what is not true", facts: "composed from the figures" };

/** What is shown as the reason, and, folded, all that the model wrote with what of it is true. */
function reasons(explanation, text, truth) {
  return [
    explanation ? el("pre", { class: "reasoning", text: explanation.text }) : null,
    explanation ? el("p", { class: "soft", text: explained_by[explanation.from] ?? explanation.from }) : null,
    text ? el("details", {}, el("summary", { text: "What the model wrote" }), el("pre", { class: "reasoning", text }), truth_check(truth)) : null,
  ].filter(Boolean);
}

/** What of the reasoning is true, and each statement that is not. */
function truth_check(truth) {
  if (!truth?.checked) return null;
  const wrong = list(truth.false), rests = wrong.some((s) => s.load_bearing);
  return el("div", {},
    el("p", {}, tag(`${truth.checked - wrong.length} of ${truth.checked} statements that can be checked are true`, rests ? "bad" : wrong.length ? "warn" : "good")),
    wrong.length ? el("ul", {}, ...wrong.map((s) => el("li", {}, el("q", { text: s.text }), `: ${s.why}`, s.load_bearing ? tag("the choice rests on it", "bad") : null))) : null);
}

function preview_steps(preview, record) {
  const { memory, check, plan } = preview, gate = memory?.gate;
  const step = (name, state, ...content) => el("li", { class: `step ${state}` }, el("h4", { text: name }), ...content);
  const case_words = memory?.case === null || memory?.case === undefined ? "no case" : `case ${memory.case}`;
  return el("ol", { class: "steps" },
    step("Memory", "done", memory ? el("p", {}, bar(memory.confidence ?? memory.similarity, `${percent(memory.confidence ?? memory.similarity)} · ${case_words}`), el("small", { text: gate_words[gate] ?? gate ?? "" })) : el("p", { class: "soft", text: "not asked" })),
    step("Language model", list(preview.answers).length ? "done" : "skipped", preview_answers(preview, record),
      ...reasons(preview.explanation, preview.reasoning, preview.truth),
      preview.prompt ? el("details", {}, el("summary", { text: "Prompt" }), el("pre", { class: "prompt", tabindex: "0", text: preview.prompt })) : null),
    step("Rollout check", check ? (check.passed ? "done" : "failed") : "skipped",
      check ? el("p", {}, tag(check.passed ? "✓ passed" : "✕ failed", check.passed ? "good" : "bad"), " ", check.text ?? "") : el("p", { class: "soft", text: "not needed, or not reached" })),
    step("Plan", plan ? "done" : "skipped", el("p", {}, plan
      ? el("span", {}, el("b", { text: `${plan.policy} ${list(preview.facts).find((f) => f.policy === plan.policy)?.name ?? ""}` }), ` ${plan_words(plan.policy, plan)}`,
        is_number(preview.ready_s) ? el("small", { text: ` cached at ${num(preview.ready_s, 2, "s")}` }) : null)
      : el("span", { class: "soft", text: "none was cached" }))));
}

/** Tabs, one per preview; on paper all are shown. */
function show_previews(record, show_in_plan) {
  const panel = by_id("previews"), chosen = shown_preview(record);
  if (!record.previews.length) {
    panel.append(el("p", { class: "soft", text: "No situation at the trigger was forecast in this encounter." }));
    return;
  }
  const tabs = el("div", { class: "tabs", role: "tablist", "aria-label": "Previews" }), bodies = [];
  const select = (k, focus) => {
    [...tabs.children].forEach((tab, i) => { tab.setAttribute("aria-selected", String(i === k)); tab.tabIndex = i === k ? 0 : -1; if (i === k && focus) tab.focus(); });
    bodies.forEach((body, i) => body.classList.toggle("closed", i !== k));
  };
  record.previews.forEach((preview, k) => {
    const matched = record.decision?.preview === k;
    tabs.append(el("button", { type: "button", role: "tab", id: `tab-${k}`, "aria-controls": `preview-${k}`, onclick: () => select(k, false),
      onkeydown: (e) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
        if (step) { select((k + step + bodies.length) % bodies.length, true); e.stopPropagation(); e.preventDefault(); }
      } },
    el("b", { text: `Preview ${k + 1}` }), ` ${percent(preview.probability)}`, matched ? tag("matched", "strong") : null));
    bodies.push(el("div", { class: "preview", role: "tabpanel", id: `preview-${k}`, "aria-labelledby": `tab-${k}` },
      el("div", { class: "preview-head" }, el("h3", { text: `Preview ${k + 1}: probability ${percent(preview.probability)}` }),
        el("button", { type: "button", class: "quiet", text: "Show in plan view", onclick: () => show_in_plan(k) })),
      el("div", { class: "columns" },
        el("div", {}, el("h4", { text: "Who, and what they may do" }), preview_actors(preview), el("h4", { text: "What each policy is forecast to bring" }), preview_facts(preview)),
        el("div", {}, el("h4", { text: "How the plan came about" }), preview_steps(preview, record)))));
  });
  panel.append(tabs, ...bodies);
  select(Math.min(chosen, bodies.length - 1), false);
}

function show_run(record) {
  const { timing, scenario } = record;
  const rows = [["Scenario", scenario.name], ["Source", scenario.source], ["Pace", record.pace], ["Language model", record.model], ["Forecasts", record.atlas ? "from the atlas" : "all rolled out"],
    ["Grip", num(record.grip, 2)], ["Stored in memory as", record.case === null || record.case === undefined ? "not stored" : `case ${record.case}`],
    ["Reflex calls", is_number(timing.reflex_calls) ? String(timing.reflex_calls) : none],
    ["Reflex call, median / longest", `${num(timing.reflex_us_p50, 1)} / ${num(timing.reflex_us_max, 1, "µs")}`],
    ["Processor time: thinking / verdicts", is_number(timing.thinking_cpu_s) ? `${num(timing.thinking_cpu_s, 2)} / ${num(timing.verdict_cpu_s, 2, "s")}` : none],
    ["Preview / first answer / answer after T2", `${num(timing.preview_s, 2)} / ${num(timing.first_answer_s, 2)} / ${num(timing.answer_s, 2, "s")}`],
    ["Deadlines missed", is_number(timing.deadline_misses) ? String(timing.deadline_misses) : none]];
  by_id("run").append(el("dl", { class: "facts" }, rows.map(([k, v]) => el("div", {}, el("dt", { text: k }), el("dd", { text: v ?? none })))));
}

function show_events(record, seek) {
  const box = by_id("event-list");
  box.querySelector("summary").textContent = `All events (${record.events.length})`;
  box.querySelector(".scroll").append(el("table", {}, el("thead", {}, el("tr", {}, ["Time", "Plane", "Event", "What"].map((h) => el("th", { scope: "col", text: h })))),
    el("tbody", {}, record.events.map((event) => el("tr", {},
      el("td", {}, el("button", { type: "button", class: "link", text: num(event.t_s, 2, "s"), onclick: () => seek(event.t_s, event) })),
      el("td", { text: event.plane }), el("td", { text: event_words[event.kind] ?? event.kind }), el("td", { text: event.text ?? "" }))))));
}
