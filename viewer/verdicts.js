// The verdicts over time: what each plan was expected to end in, as a chart with the admissible set, and in words.

const verdict_hold = 0.1;   // [s] that a verdict is decided by where none follows
const verdict_join = 0.3;   // [s] between verdicts that one line joins
const harm_ticks = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
const harm_pad = { left: 44, right: 12, bottom: 22 };  // around the curves [px]
const mark_height = 17;     // of a row of names above the curves [px]
const verdict_row = 0.25;   // [s] between the rows of the table, but for those by which a plan was begun

const is_plan = (plan) => Boolean(plan) && typeof plan === "object" && is_number(plan.policy);
const harm_of = (plan) => (is_number(plan?.harm) && plan.harm >= 0 ? plan.harm : null);

/**
 * Verdicts by time, and how many of the record's cannot be read. A plan's key is the same in each verdict: its policy, and which of
 * that policy's plans it is.
 */
function read_verdicts(raw) {
  const given = list(dict(raw).in_hand);
  const whole = given.filter((one) => one && is_number(one.t_s) && list(one.plans).length && one.plans.every(is_plan));
  const all = whole.map((one) => {
    const count = new Map();
    const plans = one.plans.map((plan) => {
      count.set(plan.policy, (count.get(plan.policy) ?? -1) + 1);
      return { ...plan, harm: harm_of(plan), key: `${plan.policy}/${count.get(plan.policy)}` };
    });
    return { ...one, plans, under_way: is_plan(one.under_way) ? one.under_way : null, least: least_of(plans),
      most: is_number(one.admissible_harm) ? one.admissible_harm : null, received_s: is_number(one.received_s) ? one.received_s : one.t_s };
  }).sort((a, b) => a.t_s - b.t_s);
  return { all, unreadable: given.length - whole.length, left_out: is_number(dict(raw).left_out) ? dict(raw).left_out : 0 };
}

function least_of(plans) {
  return plans.filter((plan) => plan.harm !== null).reduce((least, plan) => (least && least.harm <= plan.harm ? least : plan), null);
}

/** The plan of a verdict that is this one: of the same policy, with the nearest target speed or strength; null: none. */
function same_plan(verdict, plan) {
  const off = (one) => Math.abs((one.target_speed_mps ?? 0) - (plan.target_speed_mps ?? 0)) + Math.abs((one.strength ?? 1) - (plan.strength ?? 1));
  return verdict.plans.filter((one) => one.policy === plan.policy).reduce((best, one) => (best && off(best) <= off(one) ? best : one), null);
}

/** What was begun, by time: at T1, then by the switches; each with the verdict that it was begun by, or null. */
function read_begun(record) {
  const begun = [{ ...dict(record.decision), t_s: record.decision?.time_s, word: "T1", why: "" },
    ...record.switches.map((one) => ({ ...one, word: "switch", why: one.reason ?? "" }))].filter((one) => is_number(one.t_s) && is_plan(one));
  for (const one of begun) {
    const by = one.word === "T1" ? record.decision.verdict?.t_s : null;
    one.verdict = record.verdicts.all.findLast((v) => (is_number(by) ? v.t_s === by : v.received_s <= one.t_s + 1e-9 && !v.by_atlas && one.word === "switch")) ?? null;
  }
  return begun.sort((a, b) => a.t_s - b.t_s);
}

/** What is carried out at t; null: nothing yet. */
const carried_out_at = (record, t) => record.begun.findLast((one) => one.t_s <= t + 1e-9) ?? null;

/** The newest verdict of a scene not later than t; null: none that holds. */
function verdict_at(record, t) {
  const one = record.verdicts.all.findLast((verdict) => verdict.t_s <= t + 1e-9);
  return one && t - one.t_s <= verdict_join ? one : null;
}

const when_words = (record, t) => (is_number(record.t1) ? `T1 ${signed(t - record.t1)}\u00A0s` : num(t, 2, "s"));
const harm_words = (plan) => (plan && is_number(plan.harm) ? `${plan_name(plan)}: ${num(plan.harm, 4)}` : none);
const admissible_of = (verdict) => (verdict.most === null ? [] : verdict.plans.filter((plan) => plan.harm !== null && plan.harm <= verdict.most));

class VerdictChart {
  /** @param seek  called with a time when the reader goes somewhere */
  constructor(box, record, seek) {
    Object.assign(this, { box, record, seek, hot: null, t: record.start });
    this.verdicts = record.verdicts.all;
    const times = [...this.verdicts.map((v) => v.t_s), ...record.begun.map((b) => b.t_s)];
    this.from = Math.min(...times);
    this.to = Math.max(...times.map((t) => t + verdict_hold), this.from + 0.5);
    this.top = 1.08 * Math.max(0.01, ...this.verdicts.flatMap((v) => [...v.plans, v.under_way]).map(harm_of).filter(is_number));
    this.keys = [...new Set(this.verdicts.flatMap((v) => v.plans.map((plan) => plan.key)))];
    this.readout = el("p", { class: "verdict-readout", "aria-live": "off" });
    this.track = el("div", { class: "verdict-track" });
    box.append(this.track, this.readout);
    const over = (event) => this.hover(event);
    this.track.addEventListener("pointermove", over);
    this.track.addEventListener("pointerleave", () => { this.hot = null; this.show(this.t); });
    follow_pointer(this.track, (event) => event.button === 0, (event) => {
      this.seek(Math.min(Math.max(this.time(event), this.from), this.to));
      over(event);
    });
  }

  x(t) { return harm_pad.left + ((t - this.from) / (this.to - this.from)) * this.plot; }
  y(harm) { return this.above + (1 - Math.sqrt(Math.min(harm, this.top) / this.top)) * this.inner; }
  time(event) { return this.from + ((event.clientX - this.track.getBoundingClientRect().left - harm_pad.left) / this.plot) * (this.to - this.from); }

  layout() {
    this.width = Math.max(240, this.track.clientWidth);
    this.plot = this.width - harm_pad.left - harm_pad.right;
    this.inner = this.width < 560 ? 190 : 230;
    const marks = this.marks();
    this.above = 6 + mark_height * Math.max(0, ...marks.map((mark) => mark.row + 1));
    this.height = this.above + this.inner + harm_pad.bottom;
    this.cursor = svg("line", { class: "verdict-cursor", y1: this.above, y2: this.above + this.inner });
    this.spot = svg("g", { class: "verdict-spot" });
    this.drawing = svg("svg", { width: this.width, height: this.height, viewBox: `0 0 ${this.width} ${this.height}`, role: "img", "aria-label": this.summary() },
      this.grid(), this.band(), this.curves(), this.upright(marks), this.cursor, this.spot);
    this.track.replaceChildren(this.drawing);
    this.show(this.t);
  }

  // --- the parts ----------------------------------------------------------------------------------

  grid() {
    const shown = [0], lines = [];
    for (const v of [...harm_ticks].reverse()) if (v <= this.top && shown.every((other) => Math.abs(this.y(other) - this.y(v)) > 17)) shown.push(v);
    for (const v of shown) {
      lines.push(svg("line", { x1: harm_pad.left, x2: this.width - harm_pad.right, y1: this.y(v), y2: this.y(v), class: "grid" }),
        svg("text", { x: harm_pad.left - 6, y: this.y(v) + 3.5, class: "tick", "text-anchor": "end", text: String(v) }));
    }
    const zero = is_number(this.record.t1) ? this.record.t1 : this.record.start, span = this.to - this.from;
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10].find((s) => span / s <= this.plot / 56) ?? 20;
    for (let k = Math.ceil((this.from - zero) / step - 1e-9); zero + k * step <= this.to + 1e-9; k++) {
      const x = this.x(zero + k * step), text = k === 0 && is_number(this.record.t1) ? "T1" : `${signed(k * step, step < 1 ? 1 : 0)}`;
      lines.push(svg("text", { x, y: this.height - 6, class: "tick", "text-anchor": x > this.width - 24 ? "end" : "middle", text }));
    }
    lines.push(svg("text", { x: harm_pad.left - 24, y: this.height - 6, class: "tick", "text-anchor": "end", text: "s" }));
    return lines;
  }

  /** Runs of points [t, value] that one line joins; the last of each holds as long as a verdict is decided by, `until` at most. */
  runs(points, until = this.to) {
    const all = [];
    for (const point of points) {
      const run = all[all.length - 1], last = run?.[run.length - 1];
      if (last && point[0] - last[0] <= verdict_join) run.push(point); else all.push([point]);
    }
    return all.map((run) => [...run, [Math.min(run[run.length - 1][0] + verdict_hold, Math.max(until, run[run.length - 1][0])), run[run.length - 1][1]]]);
  }

  line(points, until) { return this.runs(points, until).map((run) => this.path(run)).join(""); }
  path(run) { return run.map(([t, v], k) => `${k ? "L" : "M"}${this.x(t).toFixed(1)} ${this.y(v).toFixed(1)}`).join(""); }

  /** The admissible set S: whatever lies in the band counts as the best. */
  band() {
    const points = this.verdicts.filter((v) => v.most !== null).map((v) => [v.t_s, v.most]);
    const d = this.runs(points).map((run) => `${this.path([...run, [run[run.length - 1][0], 0], [run[0][0], 0]])}Z`).join("");
    return [svg("path", { d, class: "verdict-band" }), svg("path", { d: this.line(points), class: "verdict-edge" })];
  }

  points_of(key) {
    return this.verdicts.map((v) => [v.t_s, v.plans.find((plan) => plan.key === key)?.harm ?? null]).filter(([, harm]) => harm !== null);
  }

  /** What was carried out: of each plan, from the verdict that it was begun by on. */
  carried_out() {
    const { begun } = this.record;
    return begun.map((one, k) => {
      const until = begun[k + 1]?.t_s ?? Infinity, first = one.verdict && same_plan(one.verdict, one);
      const points = this.verdicts.filter((v) => v.t_s > one.t_s + 1e-9 && v.t_s <= until + 1e-9 && harm_of(v.under_way) !== null).map((v) => [v.t_s, v.under_way.harm]);
      return { until, points: first && first.harm !== null ? [[one.verdict.t_s, first.harm], ...points] : points };
    }).filter(({ points }) => points.length);
  }

  curves() {
    this.paths = new Map(this.keys.map((key) => [key, svg("path", { d: this.line(this.points_of(key)), class: `verdict-line${key === "0/0" ? " aeb" : ""}` })]));
    const least = this.verdicts.filter((v) => v.least).map((v) => [v.t_s, v.least.harm]);
    return [[...this.paths].filter(([key]) => key !== "0/0").map(([, path]) => path),
      this.carried_out().map(({ points, until }) => svg("path", { d: this.line(points, Math.min(until, this.to)), class: "verdict-line carried" })),
      this.paths.get("0/0"), svg("path", { d: this.line(least), class: "verdict-line least" })];
  }

  /** The vertical marks with their words, packed into rows above the curves. */
  marks() {
    const measure = document.createElement("canvas").getContext("2d"), ends = [];
    measure.font = "600 12px system-ui, sans-serif";
    return this.record.begun.map((one) => {
      const text = `${one.word === "T1" ? "T1: " : ""}${one.name ?? plan_name(one)}${one.why ? `, ${one.why}` : ""}`, wide = measure.measureText(text).width;
      const x = this.x(one.t_s), left = Math.max(2, Math.min(x + 4, this.width - wide - 4));
      let row = ends.findIndex((end) => end <= left);
      if (row < 0) row = ends.push(0) - 1;
      ends[row] = left + wide + 10;
      return { one, text, x, left, row };
    });
  }

  upright(marks) {
    return marks.map(({ one, text, x, left, row }) => svg("g", { class: `verdict-mark ${one.word}` },
      svg("line", { x1: x, x2: x, y1: 4 + row * mark_height, y2: this.above + this.inner }),
      svg("text", { x: left, y: 15 + row * mark_height, text })));
  }

  summary() {
    const begun = this.record.begun.map((one) => `${one.word === "T1" ? "at T1" : `at ${when_words(this.record, one.t_s)}, ${one.why},`} ${plan_name(one)} began${one.verdict ? `, expected harm ${num(same_plan(one.verdict, one)?.harm, 4)}, least ${harm_words(one.verdict.least)}` : ""}`);
    return `Expected harm of ${this.keys.length} plans in ${this.verdicts.length} verdicts: ${begun.join("; ") || "nothing was begun"}`;
  }

  // --- the cursor and the pointer -----------------------------------------------------------------

  /** The plan under the pointer: in the verdict nearest in time, the line nearest in harm. */
  hover(event) {
    const t = this.time(event), y = event.clientY - this.track.getBoundingClientRect().top;
    const verdict = this.verdicts.reduce((best, v) => (Math.abs(v.t_s - t) < Math.abs(best.t_s - t) ? v : best));
    const plan = verdict.plans.filter((one) => one.harm !== null).reduce((best, one) => (best && Math.abs(this.y(best.harm) - y) <= Math.abs(this.y(one.harm) - y) ? best : one), null);
    this.hot = plan && Math.abs(this.y(plan.harm) - y) < 24 && Math.abs(this.x(verdict.t_s) - this.x(t)) < 40 ? { verdict, plan } : null;
    this.show(this.t);
  }

  show(t) {
    this.t = t;
    if (!this.paths) return;
    const x = this.x(Math.min(Math.max(t, this.from), this.to));
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    for (const [key, path] of this.paths) path.classList.toggle("hot", key === this.hot?.plan.key);
    this.spot.replaceChildren(...(this.hot ? this.spot_of(this.hot) : []));
    this.readout.replaceChildren(...this.words(this.hot?.verdict ?? verdict_at(this.record, t)));
  }

  spot_of({ verdict, plan }) {
    const x = this.x(verdict.t_s), y = this.y(plan.harm), right = x > 0.6 * this.width;
    return [svg("circle", { cx: x, cy: y, r: 4 }),
      svg("text", { x: right ? x - 9 : x + 9, y: Math.max(this.above + 10, y - 7), "text-anchor": right ? "end" : "start", text: `${plan_name(plan)}: ${num(plan.harm, 4)}, contact ${percent(plan.contact)}` })];
  }

  words(verdict) {
    if (!verdict) return [el("span", { class: "soft", text: "No verdict at the cursor." })];
    const item = (name, text) => el("span", {}, el("small", { text: `${name} ` }), el("b", { text }));
    const aeb = verdict.plans.find((plan) => plan.key === "0/0");
    return [item("Scene of", when_words(this.record, verdict.t_s)), item("carried out", harm_words(verdict.under_way)), item("AEB", aeb ? num(aeb.harm, 4) : none), item("least", harm_words(verdict.least)),
      item("S up to", `${num(verdict.most, 4)}, ${admissible_of(verdict).length} of ${verdict.plans.length} plans`),
      is_plan(verdict.speaks_for) ? item("speaks for", plan_name(verdict.speaks_for)) : ""];
  }
}

// --- the panel ------------------------------------------------------------------------------------

/** Verdicts that the table tells: those by which something was begun, and of the others one every quarter of a second. */
function told_verdicts(record) {
  const told = [];
  for (const verdict of record.verdicts.all) {
    const begun = record.begun.some((one) => one.verdict === verdict);
    if (begun || !told.length || verdict.t_s - told[told.length - 1].t_s >= verdict_row - 1e-9) told.push(verdict);
  }
  return told;
}

function verdicts_over_time(record) {
  const rows = told_verdicts(record).map((verdict) => {
    const begun = record.begun.filter((one) => one.verdict === verdict), aeb = verdict.plans.find((plan) => plan.key === "0/0");
    return { class: begun.length ? "chosen" : "", cells: [
      el("span", {}, `${num(verdict.t_s, 2, "s")}`, ...begun.map((one) => tag(`${plan_name(one)} begun by it`, "strong"))), harm_words(verdict.under_way),
      aeb ? num(aeb.harm, 4) : none, harm_words(verdict.least), num(verdict.most, 4), admissible_of(verdict).map(plan_name).join(", ") || none] };
  });
  const caption = `Verdicts in words: ${rows.length} of ${record.verdicts.all.length}, those by which a plan was begun among them`;
  return el("details", {}, el("summary", { text: caption }), table(caption, ["Scene", "Carried out", "AEB", "Least", "S up to", "Plans in S"], rows));
}

/** What was begun and why, each with a way to its hypotheses in the plan view. */
function begun_list(record, show_hypotheses) {
  return el("ul", { class: "begun" }, record.begun.map((one) => {
    const k = record.hypotheses.findIndex((h) => Math.abs(h.t_s - one.t_s) < 1e-9), harm = one.verdict ? same_plan(one.verdict, one)?.harm : null;
    return el("li", {}, tag(when_words(record, one.t_s)), " ", el("b", { text: plan_name(one) }), one.why ? ` – ${one.why}` : "",
      is_number(harm) ? `: expected harm ${num(harm, 4)}, ${harm <= one.verdict.least.harm ? "the least of all" : `the least was that of ${harm_words(one.verdict.least)}`}` : "", " ",
      k >= 0 ? el("button", { type: "button", class: "quiet", text: "Hypotheses in plan view", onclick: () => show_hypotheses(k) }) : null);
  }));
}

/** The panel, and the chart in it; null: the record holds no verdicts. */
function show_verdicts(record, seek, show_hypotheses) {
  const panel = by_id("verdicts"), { all, unreadable, left_out } = record.verdicts;
  const lost = unreadable ? el("p", { class: "soft", text: `${unreadable} of the record's verdicts cannot be read and are left out.` }) : null;
  if (!all.length) {
    panel.append(lost ?? el("p", { class: "soft", text: "This record holds no verdicts over time." }));
    return null;
  }
  const sign = (kind, text) => el("span", { class: "key" }, svg("svg", { width: 22, height: 10, "aria-hidden": "true" }, svg("path", { d: "M0 5H22", class: `verdict-line ${kind}` })), text);
  panel.append(el("p", { class: "soft", text: "Each verdict drives every plan from one scene and holds it against draws of what the others may do. The scale is that of the square root, so that small harms are told apart." }),
    el("p", { class: "verdict-legend" }, sign("carried", "carried out"), sign("aeb", "AEB"), sign("least", "the least of all"), sign("", "another plan: point at it"),
      el("span", { class: "key" }, el("i", { class: "swatch verdict-s", "aria-hidden": "true" }), "admissible set S: what counts as the least")));
  const chart = new VerdictChart(panel.appendChild(el("div", { class: "verdict-chart" })), record, seek);
  panel.append(begun_list(record, show_hypotheses));
  for (const one of record.begun.filter((b) => b.word === "switch" && b.verdict)) panel.append(...verdict_table(one.verdict, one, `at the switch at ${num(one.t_s, 2, "s")}`));
  panel.append(verdicts_over_time(record));
  if (left_out) panel.append(el("p", { class: "soft", text: `The record leaves out ${left_out} verdicts in between.` }));
  if (lost) panel.append(lost);
  return chart;
}
