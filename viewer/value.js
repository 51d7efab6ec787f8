// The page of a solved value: joins sliders, map and words.

const record = JSON.parse(by_id("record").textContent);
const table_of_values = new ValueTable(record);
const plot = new ValuePlot(by_id("map"), record, table_of_values);
const shown = { time: record.start.time, others: [...record.start.others] };
const shown_axes = plot.axes;
const course_axis = shown_axes.findIndex((axis, d) => d >= 2 && axis.name === "course");

const in_words = (axis, value, decimals = 1) => num(value * axis.factor, decimals, axis.unit);
const others_in_words = () => shown_axes.slice(2).map((axis, i) => `${axis.name} ${in_words(axis, shown.others[i + 2])}`);

function slider(name, { min, max, step, value }, words, change) {
  const out = el("output", { text: words(value) });
  const input = el("input", { type: "range", min, max, step, value, "aria-valuetext": words(value), oninput: () => {
    change(Number(input.value));
    out.textContent = words(Number(input.value));
    input.setAttribute("aria-valuetext", out.textContent);
    later();
  } });
  return el("label", { class: "slider" }, el("span", { text: name }), out, input);
}

function show_controls() {
  const sliders = shown_axes.slice(2).map((axis, i) => {
    const at = axis.coordinates, max = axis.edge === "periodic" ? axis.last : at[at.length - 1];
    return slider(axis.name, { min: at[0], max, step: (max - at[0]) / 360, value: shown.others[i + 2] }, (value) => in_words(axis, value),
      (value) => { shown.others[i + 2] = value; });
  });
  if (record.times_s.length > 1) {
    sliders.push(slider("horizon", { min: 0, max: record.times_s.length - 1, step: 1, value: shown.time }, (k) => num(record.times_s[k], 2, "s"),
      (k) => { shown.time = k; }));
  }
  sliders.push(slider("zoom", { min: 1, max: 8, step: 0.05, value: record.start.zoom }, (factor) => `${num(factor, 2)}\u00A0\u00D7`,
    (factor) => plot.zoom(factor)));
  by_id("controls").append(...sliders);
}

let asked = false;
/** Draws at most once a frame. */
function later() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; lay_out(); });
}

function draw() {
  const share = plot.show(shown.time, shown.others, course_axis >= 0 ? shown.others[course_axis] : null);
  const at = others_in_words();
  const words = `${shown_axes[0].name} and ${shown_axes[1].name}${at.length ? ` at ${at.join(", ")}` : ""}, horizon ${num(record.times_s[shown.time], 2, "s")}`;
  by_id("sentence").textContent = `V over ${words}: ${num(100 * share, 1, "%")} of what is shown is unsafe.`;
  by_id("map").setAttribute("aria-label", by_id("sentence").textContent);
}

function lay_out() {
  plot.layout(by_id("map-box").clientWidth - 24, shown.others);
  draw();
}

function show_legend() {
  const key = (kind, text) => el("span", { class: "key" }, el("i", { class: `swatch ${kind}`, "aria-hidden": "true" }), text);
  by_id("legend").append(key("unsafe", "V \u2265 0: nothing helps any more"), key("safe", "V < 0: can be avoided"), key("zero", "V = 0"), record.shown ? key("unknown", "not solved for") : "",
    record.outline.length ? key("outline", "obstacle") : "", course_axis >= 0 ? el("span", { text: "arrow: course" }) : "",
    el("span", { id: "reading", text: "point at the map to read it" }));
  by_id("map").addEventListener("pointermove", (event) => {
    const read = plot.reading(event), [x, y] = shown_axes;
    by_id("reading").textContent = read && Number.isNaN(read.value) ? "not solved for" : read
      ? `${x.name} ${in_words(x, read.x)}, ${y.name} ${in_words(y, read.y)}: V ${num(read.value, 2, record.value_unit)}` : "";
  });
}

function show_about() {
  const rows = record.axes.map((axis) => ({ cells: [axis.name, `${num(axis.coordinates[0] * axis.factor)} to ${in_words(axis, axis.last)}`,
    `${axis.points}${axis.points > axis.coordinates.length ? `, of which ${axis.coordinates.length} are here` : ""}`, axis.edge] }));
  by_id("about").append(table("Axes of the grid", ["axis", "range", "points", "ends"], rows),
    el("p", { class: "soft", text: `Values are kept here in one byte each: within ${num(record.rounding, 3, record.value_unit)}, far finer near 0. ${
      record.complete ? "" : "The solution was stopped before its horizon."}` }),
    record.problem ? el("details", {}, el("summary", { text: "The case's file" }), el("pre", { text: record.problem })) : "");
}

by_id("title").textContent = record.title;
document.title = `SACA value: ${record.title}`;
show_controls();
show_legend();
show_about();
lay_out();
watch_size(by_id("map-box"), (box) => box.clientWidth, lay_out);
watch_theme(draw, lay_out);
