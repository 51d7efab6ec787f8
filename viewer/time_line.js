// Scrubber, phases, the lanes of both planes, the charts and the intentions: strips over one time axis with one cursor.

const lanes = [
  { plane: "reflex", name: "Reflex plane", note: "never waits" },
  { plane: "thinking", name: "Thinking plane", note: "may be late" },
  { plane: "world", name: "World", note: "" }];
const label_height = 20;
const chart_height = 88;

class TimeLine {
  /** @param seek  called with a time when the reader goes somewhere */
  constructor(root, record, seek) {
    this.root = root;
    this.record = record;
    this.seek = seek;
    this.whole = false;
    this.threat = record.result.contact?.with ?? most_dangerous(record);  // whose speed is drawn beside the ego's
    if (!record.shape_of.has(this.threat)) this.threat = null;
    this.story_start = is_number(record.t2) ? Math.max(record.start, record.t2 - 2) : record.start;
    this.scrub = el("input", { type: "range", id: "scrub", min: "0", max: "1000", step: "any", value: "0", "aria-label": "Time",
      oninput: () => this.seek(this.from + (Number(this.scrub.value) / 1000) * (this.to - this.from)) });
    this.cursor = el("div", { class: "cursor", "aria-hidden": "true" });
    this.build();
  }

  get from() { return this.whole ? this.record.start : this.story_start; }
  get to() { return Math.max(this.record.end, this.from + 0.1); }
  get has_more() { return this.story_start - this.record.start > 0.5; }

  x(t) { return ((t - this.from) / (this.to - this.from)) * this.width; }

  build() {
    const strip = (name, note, kind) => {
      const track = el("div", { class: `track ${kind}` });
      const value = el("span", { class: "strip-value" });
      this.root.append(el("div", { class: `strip strip-${kind}` },
        el("div", { class: "strip-name" }, el("span", { text: name }), note ? el("small", { text: note }) : null, value), track));
      return { track, value };
    };
    this.scrub_track = strip("Time", "", "scrub").track;
    this.scrub_track.append(this.scrub);
    this.phase_track = strip("Phase", "", "phases").track;
    this.lane_tracks = lanes.map((lane) => strip(lane.name, lane.note, `lane ${lane.plane}`).track);
    this.charts = [
      { ...strip("Speed", this.threat ? `dotted: ${this.threat}` : "", "chart"), key: "speed", unit: "m/s", read: (f) => f.ego.speed_mps, limits: [],
        other: this.threat === null ? null : (f) => list(f.actors).find((a) => a.id === this.threat)?.speed_mps },
      { ...strip("Time to conflict", "", "chart"), key: "conflict", unit: "s", read: (f) => f.conflict_s, top: 8,
        limits: [["T2", this.record.thresholds.preview_s], ["T1", this.record.thresholds.trigger_s]] }];
    this.intentions = new Intentions(this.record);
    this.intentions.build(strip);
    this.axis_track = strip("", "", "axis").track;
    this.root.append(this.cursor);
    follow_pointer(this.root, (e) => e.target.closest(".track") && !e.target.closest("button, input"), (e) => this.go(e));
  }

  /** Goes to the time under the pointer. */
  go(event) {
    const box = this.axis_track.getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    this.seek(this.from + share * (this.to - this.from));
  }

  layout() {
    this.width = this.axis_track.clientWidth;
    this.left = this.axis_track.offsetLeft;
    this.narrow = this.width < 560;
    this.draw_phases();
    lanes.forEach((lane, i) => this.draw_lane(this.lane_tracks[i], lane.plane));
    for (const chart of this.charts) this.draw_chart(chart);
    this.intentions.layout((t) => this.x(t), this.from, this.width);
    this.draw_axis();
  }

  phases() {
    const { record } = this, spans = [];
    for (const frame of record.frames) {
      const last = spans[spans.length - 1], plan = frame.phase === "manoeuvre" ? carried_out_at(record, frame.t_s)?.name : undefined;
      if (last && last.phase === frame.phase && last.plan === plan) last.to = frame.t_s;
      else {
        if (last) last.to = frame.t_s;
        spans.push({ phase: frame.phase, plan, from: frame.t_s, to: frame.t_s });
      }
    }
    return spans;
  }

  draw_phases() {
    this.phase_track.replaceChildren(...this.phases().filter((s) => s.to > this.from).map((span) => {
      const left = Math.max(0, this.x(span.from)), width = this.x(span.to) - left;
      const words = { recorded: "as recorded", driving: width > 160 ? "driving on, previewing" : "previewing", manoeuvre: span.plan ?? "manoeuvre" };
      return el("span", { class: `phase phase-${span.phase}`, style: { left: `${left}px`, width: `${Math.max(2, width)}px` },
        title: span.phase, text: width > 80 ? words[span.phase] ?? span.phase : "" });
    }));
  }

  /** Events of one kind that stand close share one label; labels are packed into as few rows as they need. */
  groups(plane) {
    const all = [], open = new Map();
    for (const event of this.record.events) {
      if (event.plane !== plane || event.t_s < this.from - 1e-9) continue;
      const x = this.x(event.t_s), group = open.get(event.kind);
      if (group && x - group.x_last < 90 && event.kind !== "fault") { group.events.push(event); group.x_last = x; }
      else { const made = { kind: event.kind, events: [event], x_first: x, x_last: x }; open.set(event.kind, made); all.push(made); }
    }
    return all;
  }

  draw_lane(track, plane) {
    track.replaceChildren();
    const rows = [], measure = document.createElement("canvas").getContext("2d");
    measure.font = "600 12px system-ui, sans-serif";
    for (const group of this.groups(plane)) {
      const word = event_words[group.kind] ?? group.kind;
      const many = group.events.length > 1 ? ` ×${group.events.length}` : "";
      const key = ["preview", "trigger", "execute", "contact", "rest", "fault"].includes(group.kind);
      const text = this.narrow && !key ? "" : word + many;
      const wide = text ? measure.measureText(text).width + 10 : 0;
      const flipped = group.x_last + 12 + wide > this.width;
      const from = flipped ? group.x_first - 8 - wide : group.x_first - 8, to = flipped ? group.x_last + 8 : group.x_last + 12 + wide;
      let row = rows.findIndex((r) => r.every(([a, b]) => to <= a || from >= b));
      if (row < 0) row = rows.push([]) - 1;
      rows[row].push([from, to]);
      this.place(track, group, text, flipped, row);
    }
    track.style.height = `${Math.max(1, rows.length) * label_height + 8}px`;
  }

  place(track, group, text, flipped, row) {
    const top = row * label_height + 4;
    if (group.x_last > group.x_first) {
      track.append(el("span", { class: "span-line", style: { left: `${group.x_first}px`, width: `${group.x_last - group.x_first}px`, top: `${top + 10}px` } }));
    }
    group.events.forEach((event, i) => {
      const labelled = flipped ? i === 0 : i === group.events.length - 1;
      const words = `${event_words[event.kind] ?? event.kind} at ${num(event.t_s, 2, "s")}${event.text ? `: ${event.text}` : ""}`;
      const button = el("button", { type: "button", class: `event kind-${event.kind}${flipped ? " flipped" : ""}`, "aria-label": words, title: words,
        style: { top: `${top}px` }, onclick: () => this.seek(event.t_s, event) },
        el("span", { class: "dot", "aria-hidden": "true" }), labelled && text ? el("span", { class: "word", text }) : null);
      button.style.setProperty(flipped ? "right" : "left", `${flipped ? this.width - this.x(event.t_s) - 8 : this.x(event.t_s) - 8}px`);
      button.dataset.t = event.t_s;
      track.append(button);
    });
  }

  draw_chart(chart) {
    const { frames } = this.record, w = this.width, h = chart_height;
    const values = frames.filter((f) => f.t_s >= this.from).map(chart.read).filter(is_number);
    const most = Math.max(1, ...values, ...chart.limits.map((l) => l[1] || 0));
    const step = [1, 2, 5, 10, 20].find((s) => most / s <= 4) || 50;
    const top = chart.top ? Math.min(chart.top, Math.ceil(most / step) * step) : Math.ceil(most / step) * step;
    const y = (v) => 16 + (1 - Math.min(Math.max(v, 0), top) / top) * (h - 22);
    const lines = [];
    for (let v = 0; v <= top; v += step) lines.push(svg("line", { x1: 0, x2: w, y1: y(v), y2: y(v), class: "grid" }), svg("text", { x: 3, y: y(v) - 3, class: "tick", text: v === 0 ? "0" : `${v} ${chart.unit}` }));
    for (const [name, v] of chart.limits) {
      if (is_number(v) && v <= top) lines.push(svg("line", { x1: 0, x2: w, y1: y(v), y2: y(v), class: "limit" }), svg("text", { x: w - 4, y: y(v) - 4, class: "limit-name", text: `${name} = ${num(v, 1)} s` }));
    }
    const other = chart.other ? this.curve((f) => chart.other(f), y, top) : "";
    if (other) lines.push(svg("path", { d: other, class: "curve other" }));
    chart.track.replaceChildren(svg("svg", { width: w, height: h, viewBox: `0 0 ${w} ${h}`, role: "img",
      "aria-label": `${chart.key === "speed" ? "Speed of the ego" : "Time to conflict"} over time` }, lines, svg("path", { d: this.curve(chart.read, y, chart.top ? top : Infinity), class: "curve" })));
  }

  /** SVG path of a value over time; a gap where there is none, or where it is above `most`. */
  curve(read, y, most) {
    let path = "", pen = false;
    for (const frame of this.record.frames) {
      const v = read(frame);
      if (frame.t_s < this.from - 0.05 || !is_number(v) || v > most) { pen = false; continue; }
      path += `${pen ? "L" : "M"}${this.x(frame.t_s).toFixed(1)} ${y(v).toFixed(1)}`;
      pen = true;
    }
    return path;
  }

  draw_axis() {
    const zero = is_number(this.record.t1) ? this.record.t1 : this.record.start;
    const span = this.to - this.from, step = [0.1, 0.2, 0.5, 1, 2, 5, 10].find((s) => span / s <= this.width / 56) || 20;
    const marks = [];
    for (let k = Math.ceil((this.from - zero) / step - 1e-9); zero + k * step <= this.to + 1e-9; k++) {
      const text = k === 0 && is_number(this.record.t1) ? "T1" : signed(k * step, step < 1 ? 1 : 0);
      const x = this.x(zero + k * step), place = x < 14 ? " first" : x > this.width - 14 ? " last" : "";
      marks.push(el("span", { class: `axis-mark${place}${k === 0 ? " zero" : ""}`, style: { left: `${x}px` }, text }));
    }
    this.axis_track.replaceChildren(...marks);
    this.axis_track.previousElementSibling.firstChild.textContent = is_number(this.record.t1) ? "s from T1" : "s";
    for (const [t, name] of [[this.record.t2, "t2"], [this.record.t1, "t1"]]) {
      this.root.querySelector(`.rule-${name}`)?.remove();
      if (is_number(t) && t >= this.from) this.root.append(el("div", { class: `rule rule-${name}`, "aria-hidden": "true", style: { left: `${this.left + this.x(t)}px` } }));
    }
  }

  show(t, frame) {
    const shown = Math.min(Math.max(t, this.from), this.to);
    this.scrub.value = String((1000 * (shown - this.from)) / (this.to - this.from));
    this.scrub.setAttribute("aria-valuetext", `${num(t, 2)} seconds`);
    this.cursor.style.left = `${this.left + this.x(shown)}px`;
    for (const button of this.root.querySelectorAll(".event")) button.classList.toggle("past", Number(button.dataset.t) <= t + 1e-9);
    for (const chart of this.charts) {
      const v = frame ? chart.read(frame) : null;
      chart.value.textContent = num(v, 1, chart.unit);
    }
    this.intentions.show(t);
  }
}
