// Four friction circles, placed as the wheels are on the car: forward is up, to the left is left. One scale for all.

const trace_seconds = 0.3;

const in_kN = (force) => num(is_number(force) ? force / 1000 : null, 2, "kN");

class ForceCircles {
  constructor(panel, record) {
    this.record = record;
    this.most = Math.max(1, ...record.wheels.flatMap((w) => [...w.peak_N, ...w.F_x_N, ...w.F_y_N]).filter(is_number).map(Math.abs));
    this.ring = tick_step(this.most, 3);
    this.figures = record.wheels.map((wheel, i) => this.figure(wheel, i));
    panel.append(el("div", { class: "circles" }, this.figures.map((f) => f.node)),
      el("p", { class: "soft note" }, "Force of the road on each wheel, in the wheel’s own frame: up drives, down brakes, left is left. Circle: the peak force at this instant; ",
        `dotted rings: every ${num(this.ring / 1000, this.ring < 1000 ? 1 : 0, "kN")}; trail: the last ${trace_seconds} s.`));
  }

  figure(wheel, i) {
    const r = 1.08 * this.most;
    const parts = {
      peak: svg("circle", { class: "peak", r: 0 }), trace: svg("path", { class: "trace" }), force: svg("path", { class: "force" }),
      tip: svg("circle", { class: "tip", r: 0.03 * this.most }), values: el("dl", { class: "values" }), state: el("span", { class: "state" }) };
    const rings = ticks(this.ring, this.most, this.ring).map((f) => svg("circle", { class: "ring", r: f }));
    const picture = svg("svg", { viewBox: `${-r} ${-r} ${2 * r} ${2 * r}`, role: "img", "aria-label": `Tyre force, ${wheel.name ?? `wheel ${i + 1}`}` },
      parts.peak, rings, svg("path", { class: "cross", d: `M${-r} 0H${r}M0 ${-r}V${r}` }), parts.trace, parts.force, parts.tip);
    const node = el("figure", { class: `circle wheel-${i}` }, el("figcaption", {}, el("b", { text: wheel.name ?? `wheel ${i + 1}` }), parts.state), picture, parts.values);
    return { ...parts, wheel, node };
  }

  show(k) {
    const { time } = this.record;
    for (const figure of this.figures) {
      const { wheel } = figure, x = wheel.F_x_N[k], y = wheel.F_y_N[k], known = is_number(x) && is_number(y);
      figure.peak.setAttribute("r", is_number(wheel.peak_N[k]) ? wheel.peak_N[k] : 0);
      figure.force.setAttribute("d", known ? `M0 0L${-y} ${-x}` : "");
      figure.tip.setAttribute("cx", known ? -y : 0);
      figure.tip.setAttribute("cy", known ? -x : 0);
      let d = "";
      for (let j = k; j >= 0 && time[k] - time[j] <= trace_seconds + 1e-9; j--) {
        if (is_number(wheel.F_x_N[j]) && is_number(wheel.F_y_N[j])) d += `${d ? "L" : "M"}${-wheel.F_y_N[j]} ${-wheel.F_x_N[j]}`;
      }
      figure.trace.setAttribute("d", d);
      const used = known && wheel.peak_N[k] > 0 ? Math.hypot(x, y) / wheel.peak_N[k] : null;
      const locked = is_locked(this.record, wheel, k);
      figure.node.classList.toggle("locked", locked);
      figure.state.replaceChildren(...(locked ? [tag("locked", "bad")] : []));
      const rows = [["F_x", in_kN(x)], ["F_y", in_kN(y)], ["load", in_kN(wheel.load_N[k])], ["slip", num(wheel.slip[k], 2)], ["of peak", percent(used)]];
      figure.values.replaceChildren(...rows.map(([name, value]) => el("div", {}, el("dt", {}, symbol(name)), el("dd", { text: value }))));
    }
  }
}
