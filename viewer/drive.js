// The page of one manoeuvre: joins time, the plan view, the forces, the charts and the panels.

const record = read_drive(by_id("record").textContent);
const first = record.time[0] ?? 0, last = record.time[record.time.length - 1] ?? 0;

const page = new Playback({ start: first, end: last, t: record.time[sample_at(record, (first + last) / 2)] ?? 0, step: 0.01, show: () => {
  const k = sample_at(record, page.t);
  plan.show(k);
  forces.show(k);
  charts.show(k);
  show_now(k);
} });

const seek = (t) => page.seek(t);
const plan = new DrivePlan(by_id("plan-box"), record, seek);
const forces = new ForceCircles(by_id("forces"), record);
const charts = new Charts(by_id("charts"), record, seek);

function show_now(k) {
  const scrub = by_id("scrub"), t = record.time[k];
  scrub.value = String(k);
  scrub.setAttribute("aria-valuetext", `${num(t, 2)} seconds`);
  const rows = [["t", num(t, 2, "s"), "big"], ["x", num(record.x_m[k], 2, "m")], ["y", num(record.y_m[k], 2, "m")], ["heading", degrees(record.heading_deg[k])]];
  by_id("now").replaceChildren(...rows.map(([name, value, kind]) => el("div", { class: kind }, el("dt", { text: name }), el("dd", { text: value }))));
}

function show_legend() {
  const key = (kind, text) => el("span", { class: "key" }, el("i", { class: `swatch ${kind}`, "aria-hidden": "true" }), text);
  const locked = record.wheels.some((wheel) => record.time.some((_, k) => is_locked(record, wheel, k)));
  by_id("plan-legend").append(key("ego", "car at the cursor"), key("ghost", `every ${ghost_seconds} s and at the end`), key("path", "path of the centre of mass"),
    el("span", { text: `arrow: its way in ${arrow_seconds} s` }), locked ? key("locked", "locked wheel") : "",
    record.draws ? key("draw", `${list(record.draws.paths).length} of ${num(record.draws.count, 0)} draws, all ends with headings`) : "",
    el("span", { class: "road-words", text: `lane ${num(record.road.lane_width_m, 2, "m")}; lanes beside it for orientation only` }));
}

function lay_out() {
  plan.layout();
  charts.layout();
  page.show();
}

function start() {
  show_header(record);
  show_draws(record);
  show_run(record);
  show_legend();
  by_id("scrub").max = String(Math.max(1, record.time.length - 1));
  by_id("scrub").addEventListener("input", (event) => page.seek(record.time[Number(event.target.value)]));
  page.connect();
  lay_out();
  for (const id of ["plan-box", "charts"]) watch_size(by_id(id), (box) => box.clientWidth, lay_out);
  watch_theme(() => {}, lay_out);
}

start();
