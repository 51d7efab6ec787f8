// What does not move: the header, the draws, and the car, the road and the run.

const degrees = (value, decimals = 1) => (is_number(value) ? `${num(value, decimals)}°` : none);
const facts = (rows) => el("dl", { class: "facts" }, rows.map(([k, v]) => el("div", {}, el("dt", { text: k }), el("dd", { text: v ?? none }))));

/** The four figures of an end: how they are called, written, and read in the record. */
const end_figures = [
  { key: "time_s", name: "Time", words: (v, d = 2) => num(v, d, "s") },
  { key: "forward_m", name: "Forward", words: (v, d = 2) => num(v, d, "m") },
  { key: "sideways_m", name: "Sideways", words: (v, d = 2) => num(v, d, "m") },
  { key: "heading_deg", name: "Heading", words: (v, d = 1) => degrees(v, d) }];

function road_words(road) {
  const bend = road.curvature_1pm;
  if (!is_number(bend) || bend === 0) return "straight road";
  return `bend to the ${bend > 0 ? "left" : "right"}, radius ${num(Math.abs(1 / bend), 0, "m")}`;
}

function show_header(record) {
  const { policy, car, road, start, end } = record;
  const words = plan_words(policy.id, policy);
  const title = [policy.name, words].filter(Boolean).join(" – ") || "Manoeuvre";
  by_id("title").textContent = title;
  document.title = `${title} – SACA`;
  const still = is_number(end.speed_mps) && end.speed_mps > 0.05 ? ` at ${num(end.speed_mps, 1, "m/s")}` : "";
  by_id("sentence").textContent = `${car.name ?? "Car"}, ${num(car.mass_kg, 0, "kg")}, from ${num(start.speed_mps, 1, "m/s")} on a ${road_words(road)} with grip ${num(road.grip, 2)}: `
    + `${end.state ?? "end unknown"}${still} after ${num(end.time_s, 2, "s")}.`;
  const notes = { time_s: end.state ?? "", forward_m: "of the centre of mass", sideways_m: side_word(end.sideways_m, "of the start"), heading_deg: side_word(end.heading_deg, "of the lane at the start") };
  by_id("tiles").append(...end_figures.map((figure) => {
    const spread = dict(record.draws?.[figure.key]);
    const note = is_number(spread.p05) ? `5–95 %: ${figure.words(spread.p05, 1)} to ${figure.words(spread.p95, 1)}` : notes[figure.key];
    return el("div", { class: "tile", id: `end-${figure.key}` }, el("span", { class: "tile-name", text: figure.name }),
      el("b", { class: "tile-value", text: figure.words(end[figure.key]) }), el("small", { text: note }));
  }));
}

const side_word = (value, of) => (is_number(value) && Math.abs(value) >= 0.005 ? `${value > 0 ? "left" : "right"} ${of}` : "");

// --- draws ----------------------------------------------------------------------------------------

const unknown_words = [
  ["grip_sd", "Grip", percent_sd], ["mass_sd", "Mass", percent_sd], ["yaw_inertia_sd", "Yaw inertia", percent_sd],
  ["stiffness_sd", "Tyre stiffness", percent_sd], ["lag_sd_s", "Lags", (v) => num(is_number(v) ? 1000 * v : null, 0, "ms")],
  ["speed_sd_mps", "Speed at the start", (v) => num(v, 2, "m/s")]];

function percent_sd(value) { return is_number(value) ? `${num(100 * value, 0)}\u00A0%` : none; }

const per_cent = (share, decimals = 1) => (is_number(share) ? `${num(100 * share, decimals)}\u00A0%` : none);

function show_draws(record) {
  const { draws, end } = record, panel = by_id("draws");
  if (!draws) return;
  panel.hidden = false;
  const within = draws.within_10_deg, n = (content) => ({ class: "n", content });
  const rows = end_figures.map((figure) => {
    const spread = dict(draws[figure.key]);
    return { cells: [figure.name, n(figure.words(end[figure.key])), n(figure.words(spread.p05)), n(figure.words(spread.p50)), n(figure.words(spread.p95))] };
  });
  panel.append(
    el("p", { class: "soft", text: `${num(draws.count, 0)} draws of what the controller does not know, seed ${num(draws.seed, 0)}; the drive above has none of it.` }),
    el("div", { class: "draw-columns" },
      el("div", {}, within ? share_bar(within) : null, histogram(record)),
      el("div", {}, el("h4", { text: "How the draws ended" }), table("Percentiles of the ends", ["", "this drive", "5 %", "median", "95 %"], rows),
        el("h4", { text: "What was unknown: standard deviations" }),
        facts(unknown_words.map(([key, name, words]) => [name, words(dict(draws.unknown)[key])])))));
}

/** The share within 10 degrees of across the lane, with its interval. */
function share_bar(within) {
  const at = (share) => `${100 * Math.min(1, Math.max(0, share || 0))}%`;
  return el("div", { id: "within" },
    el("p", { class: "lead" }, el("b", { text: per_cent(within.share) }), ` end within 10° of across the lane; 95 % interval ${per_cent(within.low)} to ${per_cent(within.high)}`),
    el("div", { class: "share-rail", "aria-hidden": "true" }, el("span", { class: "share", style: { width: at(within.share) } }),
      el("span", { class: "interval", style: { left: at(within.low), width: at(within.high - within.low) } })));
}

/** How many draws ended at which heading. */
function histogram(record) {
  const all = list(record.draws.ends).map((end) => end.heading_deg).filter(is_number);
  if (!all.length) return null;
  const aim = record.draws.within_10_deg ? { 5: 90, 6: -90 }[record.policy.id] : undefined;
  const low_seen = Math.min(...all, ...(aim === undefined ? [] : [aim - 12])), high_seen = Math.max(...all, ...(aim === undefined ? [] : [aim + 12]));
  const bin = [0.1, 0.2, 0.5, 1, 2, 5, 10].find((b) => (high_seen - low_seen) / b <= 40) ?? 20;
  const first = Math.floor(low_seen / bin), counts = new Array(Math.floor(high_seen / bin) - first + 1).fill(0);
  for (const heading of all) counts[Math.floor(heading / bin) - first]++;
  const w = window.innerWidth < 820 ? 340 : 560, h = 150, foot = 22, pad = 30, top = Math.max(...counts);
  const x = (v) => pad + ((v / bin - first) / counts.length) * (w - 2 * pad), y = (c) => 14 + (1 - c / top) * (h - foot - 14);
  const from = first * bin, to = (first + counts.length) * bin, step = tick_step(to - from, 9);
  const picture = svg("svg", { viewBox: `0 0 ${w} ${h}`, class: "histogram", role: "img", "aria-label": `Headings of ${all.length} ends, in bins of ${bin} degrees` },
    aim === undefined ? null : svg("rect", { x: x(aim - 10), width: x(aim + 10) - x(aim - 10), y: 4, height: h - foot - 4, class: "band" }),
    counts.map((c, i) => (c ? svg("rect", { x: x((first + i) * bin) + 0.5, width: Math.max(1, x((first + i + 1) * bin) - x((first + i) * bin) - 1), y: y(c), height: h - foot - y(c), class: "bin" }) : null)),
    svg("line", { x1: pad, x2: w - pad, y1: h - foot, y2: h - foot, class: "grid zero" }),
    ticks(from, to, step).map((v) => svg("text", { x: x(v), y: h - 7, "text-anchor": "middle", class: "tick", text: `${tick_words(v, step)}°` })),
    svg("text", { x: pad - 5, y: y(top) + 4, "text-anchor": "end", class: "tick", text: String(top) }),
    is_number(record.end.heading_deg) ? svg("path", { d: `M${x(record.end.heading_deg)} ${h - foot}V4`, class: "this-drive" }) : null);
  const key = (kind, text) => el("span", { class: "key" }, el("i", { class: `swatch ${kind}`, "aria-hidden": "true" }), text);
  return el("div", {}, el("h4", { text: "Headings at the end: number of draws" }), picture,
    el("p", { class: "legend" }, key("bin", `draws, bins of ${bin}°`), aim === undefined ? null : key("band", "within 10° of across the lane"), key("this-drive", "this drive")));
}

// --- car, road, run -------------------------------------------------------------------------------

function show_run(record) {
  const { car, road } = record;
  by_id("run").append(facts([
    ["Car", car.name], ["Mass", num(car.mass_kg, 0, "kg")],
    ["Centre of mass to front / rear axle", `${num(car.front_arm_m, 2)} / ${num(car.rear_arm_m, 2, "m")}`],
    ["Length × width", `${num(car.length_m, 2)} × ${num(car.width_m, 2, "m")}`], ["Front bumper ahead of the centre of mass", num(car.front_end_m, 2, "m")],
    ["Track, wheel radius", `${num(car.track_width_m, 2)}, ${num(car.wheel_radius_m, 2, "m")}`],
    ["Limits: steering", degrees(car.steering_limit_deg)], ["Limits: motor, brake of a wheel", `${num(car.motor_limit_Nm, 0)}, ${num(car.brake_limit_Nm, 0, "Nm")}`],
    ["Road", `${road_words(road)}, lane ${num(road.lane_width_m, 2, "m")}`], ["Grip", num(road.grip, 2)],
    ["Speed at the start", num(record.start.speed_mps, 2, "m/s")],
    ["Target speed", num(record.policy.target_speed_mps, 2, "m/s")], ["Share of the grip for the brakes", num(record.policy.strength, 2)], ["Samples", String(record.time.length)], ["Program", record.program]]),
  el("pre", { text: record.command ?? none, "aria-label": "Command that made this record", tabindex: "0" }));
}
