// The page of an encounter: joins time, the plan view, the time line and the panels.

const record = read_record(by_id("record").textContent);

class Story extends Playback {
  told = first_event(record, "trigger");  // the event that was asked for, among several at one time

  get from() { return time_line.from; }

  seek(t, event = null) {
    this.told = event;
    if (Math.max(t, this.start) < time_line.from - 1e-9) toggle_window();
    super.seek(t);
  }
}

const page = new Story({ start: record.start, end: record.end, t: record.t1 ?? record.start, step: 0.05, show: () => {
  const frame = frame_at(record, page.t);
  plan.draw(page.t);
  time_line.show(page.t, frame);
  verdict_chart?.show(page.t);
  show_now(frame);
  show_caption();
} });

const plan = new PlanView(by_id("plan"), record);
const time_line = new TimeLine(by_id("strips"), record, (t, event) => page.seek(t, event));
const verdict_chart = show_verdicts(record, (t) => page.seek(t), (k) => { show_hypotheses(k); stage_to_view(); });

function show_now(frame) {
  const ego = frame?.ego;
  const rows = [
    ["Time", frame ? num(page.t, 2, "s") : none, "big"],
    ["Speed", num(ego?.speed_mps, 1, "m/s"), "big"],
    ["Time to conflict", num(frame?.conflict_s, 2, "s"), ""],
    ["Yaw rate", sided(ego?.yaw_rate_degps, 1, "°/s"), ""],
    ["Sideslip", sided(ego?.sideslip_deg, 1, "°"), ""],
    ["Steering", sided(ego?.steering_deg, 1, "°"), ""]];
  by_id("now").replaceChildren(...rows.map(([k, v, kind]) => el("div", { class: kind }, el("dt", { text: k }), el("dd", { text: v }))));
  const phases = { recorded: "As recorded", driving: "Driving on while previewing", manoeuvre: `Manoeuvre ${carried_out_at(record, page.t)?.name ?? ""}` };
  by_id("phase").textContent = frame ? phases[frame.phase] ?? frame.phase : "No frames in this record";
  by_id("phase").className = `on-plan phase-${frame?.phase ?? "none"}`;
  by_id("clock").textContent = frame && is_number(record.t1) ? `T1 ${signed(page.t - record.t1)}\u00A0s` : "";
}

function show_caption() {
  const before = record.events.filter((e) => e.t_s <= page.t + 1e-9);
  const event = page.told ?? before[before.length - 1];
  const box = by_id("caption");
  box.replaceChildren();
  if (event) box.append(el("b", { text: `${event_words[event.kind] ?? event.kind}` }), ` ${num(event.t_s, 2, "s")}${event.text ? ` – ${event.text}` : ""}`);
}

// --- overlays -------------------------------------------------------------------------------------

const swatch = (kind) => el("i", { class: `swatch ${kind}`, "aria-hidden": "true" });

function show_overlays() {
  const box = by_id("overlays");
  if (record.previews.length) {
    const options = [["", "none"], ...record.previews.map((p, k) => [String(k), `${k + 1} · ${percent(p.probability)}`])];
    plan.ghost_preview = shown_preview(record);
    box.append(el("label", { class: "field" }, swatch("forecast"), "Forecast", el("select", { id: "forecast", onchange: (e) => {
      plan.ghost_preview = e.target.value === "" ? null : Number(e.target.value);
      page.show();
    } }, options.map(([value, text]) => el("option", { value, text, selected: value === String(plan.ghost_preview) })))));
  }
  box.append(...hypothesis_switch(record, show_hypotheses));
  const able = record.hindsight.filter((row) => list(row.path).length > 1);
  if (!able.length) return;
  box.append(el("p", { class: "field", id: "ghosts-name" }, swatch("hindsight"), "Had it done"));
  box.append(el("div", { class: "chips", role: "group", "aria-labelledby": "ghosts-name" }, able.map((row) => {
    const on = row.policy === record.best && row.policy !== record.decision?.policy;
    if (on) plan.ghost_policies.add(row.policy);
    return el("button", { type: "button", class: "chip", "aria-pressed": String(on), title: policy_words[row.policy], text: row.name, onclick: (e) => {
      const pressed = e.currentTarget.getAttribute("aria-pressed") !== "true";
      e.currentTarget.setAttribute("aria-pressed", String(pressed));
      if (pressed) plan.ghost_policies.add(row.policy); else plan.ghost_policies.delete(row.policy);
      page.show();
    } });
  })));
}

function show_in_plan(k) {
  plan.ghost_preview = k;
  by_id("forecast").value = String(k);
  page.seek(record.t1 ?? record.end);
  stage_to_view();
}

/** Shows the hypotheses of one plan begun, at that instant; null: none. */
function show_hypotheses(k) {
  const set = record.hypotheses[k];
  plan.hypotheses.shown = set ? k : null;
  by_id("hypotheses").value = set ? String(k) : "";
  by_id("hypotheses-words").textContent = hypotheses_words(set);
  if (set) page.seek(set.t_s); else page.show();
}

function stage_to_view() {
  by_id("stage").scrollIntoView({ block: "start", behavior: calm() ? "auto" : "smooth" });
}

/** Shows and hides the danger map, and says what it is; nothing where the record has none. */
function danger_switch() {
  const { danger } = plan;
  if (!danger.maps.length) return "";
  return el("label", { class: "key switch" }, el("input", { type: "checkbox", id: "danger-switch", checked: true, onchange: (e) => {
    danger.shown = e.target.checked;
    page.show();
  } }), swatch("danger-map"), `where the ego's centre (dot) may be at this speed and course: red = no evasion avoids ${danger.actor}, blue = one does`);
}

function show_legend() {
  const { road } = record, key = (kind, text) => el("span", { class: "key" }, swatch(kind), text);
  const edge = (side, what, at) => (what ? `${side} edge ${num(Math.abs(at), 1, "m")}: ${what === "unmarked" ? "open ground" : what}` : null);
  const words = [road.topology === "intersection" ? "intersection (other road not recorded)" : road.topology,
    is_number(road.lane_width_m) ? `lane ${num(road.lane_width_m, 1, "m")}` : null, edge("left", road.left_beyond, road.left_edge_m),
    edge("right", road.right_beyond, road.right_edge_m), is_number(record.grip) ? `grip ${num(record.grip, 2)}` : null].filter(Boolean).join(" · ");
  const plan_has_threat = record.actors.some((actor) => plan.is_threat(actor.id));
  by_id("legend").append(key("ego", "ego"), plan_has_threat ? key("threat", `at risk ≥ ${risk_shown}, or hit`) : "", record.actors.length ? key("actor", plan_has_threat ? "other actor" : "actor") : "",
    record.result.contact ? key("contact", "contact") : "", record.hypotheses.length ? el("span", { class: "key" }, swatch("hypothesis"), el("span", { id: "hypotheses-words", role: "status", text: hypotheses_words(null) })) : "", danger_switch(), el("span", { text: `arrows: way in ${arrow_seconds} s` }), el("span", { class: "road-words", text: words }));
}

/** What stands short in events and marks. */
function show_short_words() {
  const { thresholds } = record, at = (s) => (is_number(s) ? ` (${num(s, 1, "s")} to a conflict)` : "");
  const intentions = Object.entries(intention_words).filter(([letters]) => letters === letters.toUpperCase());
  by_id("short-words").textContent = `T2${at(thresholds.preview_s)}: SACA takes the wheel and previews. T1${at(thresholds.trigger_s)}: it acts${is_number(thresholds.waiting_cost) ? ", or before where waiting would cost harm" : ""}. Match: the plan that was made ahead for a situation like this one. Intentions: ${
    intentions.map(([letters, words]) => `${letters} ${words}`).join(", ")}. Policies: ${record.hindsight.map((row) => `${row.name} ${policy_words[row.policy]}`).join(", ") || "none was judged"}.`;
}

// --- window, start --------------------------------------------------------------------------------

function toggle_window() {
  time_line.whole = !time_line.whole;
  show_window();
  time_line.layout();
}

function show_window() {
  by_id("window").hidden = !time_line.has_more;
  by_id("window").textContent = time_line.whole ? "From T2" : "Whole run";
}

function on_resize() {
  plan.resize();
  time_line.layout();
  verdict_chart?.layout();
  page.show();
}

function start() {
  show_header(record);
  show_decision(record);
  show_driver(record);
  show_futures(record);
  show_result(record);
  show_review(record);
  show_previews(record, show_in_plan);
  show_run(record);
  show_events(record, (t, event) => page.seek(t, event));
  show_overlays();
  show_legend();
  show_short_words();
  show_window();
  by_id("window").addEventListener("click", () => { toggle_window(); page.show(); });
  for (const [id, factor] of [["zoom-in", 1.25], ["zoom-out", 0.8]]) {
    by_id(id).addEventListener("click", () => { plan.zoom = Math.min(4, Math.max(0.25, plan.zoom * factor)); page.show(); });
  }
  page.connect();
  watch_size(by_id("plan-box"), (box) => `${box.clientWidth} ${box.clientHeight}`, on_resize);
  watch_size(by_id("strips"), (box) => box.clientWidth, on_resize);
  on_resize();
  watch_theme(() => { plan.read_colours(); page.show(); }, on_resize);
}

start();
