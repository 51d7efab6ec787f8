// What happened over time: charts over one time axis with one cursor, each with the values at the cursor beside it.

const chart_pad = { left: 46, right: 10, top: 7, bottom: 5 };  // of the curves in their track [px]

/** `look` names a colour; `thin` is a command; `most` a size that noise must not be enlarged beyond. */
function chart_list(record) {
  const wheels = (read) => record.wheels.map((wheel, i) => ({ name: wheel.name ?? `wheel ${i + 1}`, look: `wheel-${i}`, ...read(wheel) }));
  return [
    { name: "Speed", unit: "m/s", decimals: 2, least: 1, series: [{ name: "speed", look: "a", values: record.speed },
      { name: "v_x", look: "b", values: record.v_x_mps }, { name: "v_y", look: "c", values: record.v_y_mps }] },
    { name: "Yaw", unit: "°, °/s", angle: true, decimals: 1, least: 4, series: [
      { name: "yaw rate", look: "a", values: record.yaw_rate_degps, unit: "°/s" }, { name: "heading", look: "b", values: record.heading_deg, unit: "°", wraps: true }] },
    { name: "Sideslip", unit: "°", angle: true, decimals: 1, least: 4, series: [
      { name: "sideslip", look: "a", values: record.sideslip, wraps: true }] },
    { name: "Acceleration", unit: "m/s²", decimals: 2, least: 1, series: [
      { name: "a_x", look: "a", values: record.a_x_mps2 }, { name: "a_y", look: "b", values: record.a_y_mps2 }] },
    { name: "Steering", unit: "°", angle: true, decimals: 1, least: 2, series: [
      { name: "angle", look: "a", values: record.steering_deg }, { name: "command", look: "a", thin: true, values: record.steering_command_deg }] },
    { name: "Brake torque", unit: "Nm", decimals: 0, least: 100, note: "thin: command", series: wheels((w) => ({ values: w.brake_Nm, command: w.brake_command_Nm })) },
    { name: "Motor torque", unit: "Nm", decimals: 0, least: 100, series: [
      { name: "torque", look: "a", values: record.motor_Nm }, { name: "command", look: "a", thin: true, values: record.motor_command_Nm }] },
    { name: "Rim speed", unit: "m/s", decimals: 2, least: 1, series: [
      { name: "car’s speed", look: "ink", values: record.speed }, ...wheels((w) => ({ values: w.speed_mps }))] }];
}

class Charts {
  /** @param seek  called with a time when the reader goes somewhere */
  constructor(root, record, seek) {
    Object.assign(this, { root, record });
    this.from = record.time[0] ?? 0;
    this.to = Math.max(record.time[record.time.length - 1] ?? 0, this.from + 0.01);
    this.charts = chart_list(record).map((chart) => this.row(chart));
    this.axis = el("div", { class: "chart-track axis" });
    this.cursor = el("div", { class: "chart-cursor", "aria-hidden": "true" });
    root.append(...this.charts.map((chart) => chart.node), el("div", { class: "chart-row chart-axis" }, el("div", { class: "chart-side" }), this.axis), this.cursor);
    follow_pointer(root, (event) => event.target.closest(".chart-track"), (event) => {
      const x = event.clientX - this.axis.getBoundingClientRect().left - chart_pad.left;
      seek(this.from + (x / this.plot) * (this.to - this.from));
    });
  }

  row(chart) {
    const track = el("div", { class: "chart-track" });
    for (const series of chart.series) series.cell = el("dd");
    const legend = chart.series.map((series) => el("div", {},
      el("dt", {}, svg("svg", { width: 18, height: 8, "aria-hidden": "true" }, svg("path", { d: "M0 4H18", class: `curve ${series.look}${series.thin ? " thin" : ""}` })), symbol(series.name)), series.cell));
    const node = el("div", { class: "chart-row" }, el("div", { class: "chart-side" },
      el("h3", {}, chart.name, el("small", { text: ` ${chart.unit}` }), chart.note ? el("small", { class: "chart-note", text: chart.note }) : null), el("dl", {}, legend)), track);
    return { ...chart, track, node };
  }

  x(t) { return chart_pad.left + ((t - this.from) / (this.to - this.from)) * this.plot; }

  layout() {
    this.width = this.axis.clientWidth;
    this.plot = Math.max(50, this.width - chart_pad.left - chart_pad.right);
    this.step = tick_step(this.to - this.from, Math.max(2, Math.floor(this.plot / 58)));
    this.marks = ticks(this.from, this.to, this.step);
    this.axis.replaceChildren(svg("svg", { width: this.width, height: 20, "aria-hidden": "true" },
      this.marks.map((t) => svg("text", { x: this.x(t), y: 14, "text-anchor": this.x(t) > this.width - 18 ? "end" : "middle", class: "tick", text: tick_words(t, this.step) })),
      svg("text", { x: chart_pad.left - 22, y: 14, "text-anchor": "end", class: "tick axis-name", text: "t [s]" })));
    for (const chart of this.charts) this.draw(chart);
  }

  /** Bottom, top and step of a chart's axis: whole steps around the values and zero. */
  range(chart, height) {
    const values = chart.series.flatMap((s) => [...s.values, ...list(s.command)]).filter(is_number);
    const low = Math.min(0, ...values), high = Math.max(0, ...values, low + chart.least);
    const step = tick_step(high - low, Math.max(2, Math.floor(height / 22)), chart.angle);
    return { low: Math.floor(low / step + 1e-6) * step, high: Math.ceil(high / step - 1e-6) * step, step };
  }

  draw(chart) {
    const height = Math.max(84, chart.track.parentElement.firstChild.offsetHeight * (this.is_narrow() ? 0 : 1)), w = this.width;
    const inner = height - chart_pad.top - chart_pad.bottom, { low, high, step } = this.range(chart, inner);
    const y = (v) => chart_pad.top + ((high - v) / (high - low)) * inner;
    const left = chart_pad.left, right = left + this.plot;
    const grid = ticks(low, high, step).map((v) => [svg("line", { x1: left, x2: right, y1: y(v), y2: y(v), class: v === 0 ? "grid zero" : "grid" }),
      svg("text", { x: left - 6, y: y(v) + 3.5, "text-anchor": "end", class: "tick", text: tick_words(v, step) })]);
    const upright = this.marks.map((t) => svg("line", { x1: this.x(t), x2: this.x(t), y1: chart_pad.top, y2: height - chart_pad.bottom, class: "grid" }));
    chart.dots = chart.series.map((series) => svg("circle", { r: 3.2, class: `dot ${series.look}` }));
    const curve = (series, values, thin) => svg("path", { d: this.curve(values, y, series.wraps), class: `curve ${series.look}${thin ? " thin" : ""}` });
    chart.track.replaceChildren(svg("svg", { width: w, height, role: "img", "aria-label": `${chart.name} over time [${chart.unit}]` },
      upright, grid, chart.series.map((s) => (s.command ? curve(s, s.command, true) : null)), chart.series.map((s) => curve(s, s.values, s.thin)), chart.dots));
    chart.y = y;
  }

  is_narrow() { return getComputedStyle(this.charts[0].node).gridTemplateColumns.split(" ").length < 2; }

  /** SVG path of a quantity; a gap where there is none, or where an angle goes round. */
  curve(values, y, wraps) {
    let d = "", before = null;
    this.record.time.forEach((t, k) => {
      const v = values[k];
      if (is_number(v)) d += `${before === null || (wraps && Math.abs(v - before) > 180) ? "M" : "L"}${this.x(t).toFixed(2)} ${y(v).toFixed(2)}`;
      before = is_number(v) ? v : null;
    });
    return d;
  }

  show(k) {
    const t = this.record.time[k] ?? this.from;
    this.cursor.style.left = `${this.axis.offsetLeft + this.x(t)}px`;
    for (const chart of this.charts) {
      chart.series.forEach((series, i) => {
        const v = series.values[k], dot = chart.dots[i];
        series.cell.textContent = `${num(v, chart.decimals)}${is_number(v) ? series.unit ?? "" : ""}`;
        dot.setAttribute("visibility", is_number(v) ? "visible" : "hidden");
        if (is_number(v)) { dot.setAttribute("cx", this.x(t)); dot.setAttribute("cy", chart.y(v)); }
      });
    }
  }
}
