// The plan view: lane, path, outline and wheels, all to one scale. What does not move is drawn once for each width.

const ghost_seconds = 0.25;
const arrow_seconds = 0.25;  // how much of its way the velocity's arrow shows
const wheel_width = 0.22;    // drawn; the record has no width of the tyre [m]
const margin = { left: 38, right: 12, top: 12, bottom: 24 };  // of the axes [px]

class DrivePlan {
  /** @param seek  called with a time when the reader points at a place of the path */
  constructor(box, record, seek) {
    Object.assign(this, { box, record });
    follow_pointer(box, () => this.record.time.length > 1, (event) => {
      const k = this.nearest(event);
      if (k !== null) seek(this.record.time[k]);
    });
  }

  /** The outline's corners in B [m]. */
  corners() {
    const { length_m: length, width_m: width, front_end_m: front } = this.record.car;
    if (![length, width, front].every(is_number)) return [];
    return [[front, width / 2], [front - length, width / 2], [front - length, -width / 2], [front, -width / 2]];
  }

  ghosts() {
    const { time } = this.record, all = [];
    if (!time.length) return all;
    const duration = time[time.length - 1] - time[0], every = ghost_seconds * Math.max(1, Math.ceil(duration / ghost_seconds / 40));
    let before = null;
    for (let n = 0; n * every <= duration + 1e-9; n++) {
      const k = sample_at(this.record, time[0] + n * every), pose = pose_at(this.record, k);
      if (!pose || (before && Math.hypot(pose.x - before.x, pose.y - before.y) < 0.05 && Math.abs(pose.heading - before.heading) < 1)) continue;
      all.push({ k, pose });
      before = pose;
    }
    const last = pose_at(this.record, time.length - 1);
    if (last && before && all[all.length - 1].k !== time.length - 1) all.push({ k: time.length - 1, pose: last });
    return all;
  }

  /** The part of W that must be seen [m]. */
  extent() {
    const half = (this.record.road.lane_width_m || 3.5) / 2, points = [];
    const corners = this.corners();
    const add = (pose) => {
      const h = radians(pose.heading), c = Math.cos(h), s = Math.sin(h);
      points.push([pose.x, pose.y], ...corners.map(([a, b]) => [pose.x + a * c - b * s, pose.y + a * s + b * c]));
    };
    for (const { pose } of this.ghosts()) add(pose);
    for (const end of this.ends()) add(end);
    if (!points.length) points.push([0, 0], [10, 0]);
    const furthest = Math.max(...points.map((p) => p[0]));
    for (const s of [0, furthest]) for (const d of [-half - 0.3, half + 0.3]) { const p = from_lane(this.record.road, s, d); points.push([p.x, p.y]); }
    const side = (i, most) => most(...points.map((p) => p[i]));
    return { x0: side(0, Math.min) - 0.5, x1: side(0, Math.max) + 0.5, y0: side(1, Math.min) - 0.3, y1: side(1, Math.max) + 0.3 };
  }

  ends() {
    return list(this.record.draws?.ends).map((end) => ({ x: end.x_m, y: end.y_m, heading: end.heading_deg })).filter((end) => Object.values(end).every(is_number));
  }

  /** Chooses the scale and draws what stands still. */
  layout() {
    const width = Math.max(260, this.box.clientWidth), e = this.extent();
    this.upright = width < 560;  // then forward is up, else to the right
    const [across, down] = this.upright ? [e.y1 - e.y0, e.x1 - e.x0] : [e.x1 - e.x0, e.y1 - e.y0];
    const room = { x: width - margin.left - margin.right, y: (this.upright ? 0.7 : 0.44) * Math.max(480, window.innerHeight) - margin.top - margin.bottom };
    this.scale = Math.min(room.x / across, room.y / down);
    this.width = width;
    this.height = Math.max(170, this.scale * down + margin.top + margin.bottom);
    const centre = { x: margin.left + room.x / 2, y: margin.top + (this.height - margin.top - margin.bottom) / 2 };
    const mid = { x: (e.x0 + e.x1) / 2, y: (e.y0 + e.y1) / 2 };
    this.origin = this.upright ? { x: centre.x + this.scale * mid.y, y: centre.y + this.scale * mid.x } : { x: centre.x - this.scale * mid.x, y: centre.y + this.scale * mid.y };
    this.build();
  }

  /** W [m] to the picture [px]. */
  to_screen(x, y) {
    const { scale, origin } = this;
    return this.upright ? { x: origin.x - scale * y, y: origin.y - scale * x } : { x: origin.x + scale * x, y: origin.y - scale * y };
  }

  to_world(px, py) {
    const { scale, origin } = this;
    return this.upright ? { x: (origin.y - py) / scale, y: (origin.x - px) / scale } : { x: (px - origin.x) / scale, y: (origin.y - py) / scale };
  }

  nearest(event) {
    const box = this.box.getBoundingClientRect(), at = this.to_world(event.clientX - box.left, event.clientY - box.top);
    let best = null, least = Infinity;
    this.record.time.forEach((_, k) => {
      const far = Math.hypot(this.record.x_m[k] - at.x, this.record.y_m[k] - at.y);
      if (far < least) { least = far; best = k; }
    });
    return best;
  }

  build() {
    const { width, height, scale: s, origin: o } = this;
    const inner = { x: margin.left, y: margin.top, width: width - margin.left - margin.right, height: height - margin.top - margin.bottom };
    const world = this.upright ? `matrix(0 ${-s} ${-s} 0 ${o.x} ${o.y})` : `matrix(${s} 0 0 ${-s} ${o.x} ${o.y})`;
    this.moving = svg("g");
    const { grid, words } = this.axes(inner);
    this.box.replaceChildren(svg("svg", { id: "plan", width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": this.summary() },
      svg("rect", { ...inner, class: "ground" }),
      // An inner picture cuts off what lies outside.
      svg("svg", { ...inner, viewBox: `${inner.x} ${inner.y} ${inner.width} ${inner.height}` },
        svg("g", { transform: world }, this.lane(inner), grid, this.fan(),
          svg("g", { class: "ghosts" }, this.ghosts().map(({ k, pose }) => this.car(k, pose))), this.path()),
        this.instants(),
        svg("g", { transform: world }, this.moving)),
      svg("rect", { ...inner, class: "frame" }), words));
  }

  // --- what stands still ----------------------------------------------------------------------------

  axes(inner) {
    const a = this.to_world(inner.x, inner.y + inner.height), b = this.to_world(inner.x + inner.width, inner.y);
    const [x0, x1] = [Math.min(a.x, b.x), Math.max(a.x, b.x)], [y0, y1] = [Math.min(a.y, b.y), Math.max(a.y, b.y)];
    const step = [0.5, 1, 2, 5, 10, 20, 50].find((m) => m * this.scale >= 38) ?? 100;
    const grid = svg("g", { class: "plan-grid" }), words = svg("g", { class: "tick" }), bottom = inner.y + inner.height;
    const below = (at, text, kind) => words.append(svg("text", { x: at.x, y: bottom + 15, "text-anchor": "middle", class: kind, text }));
    const beside = (at, text, kind) => words.append(svg("text", { x: inner.x - 6, y: at.y + 4, "text-anchor": "end", class: kind, text }));
    for (const x of ticks(x0, x1, step)) {
      grid.append(svg("line", { x1: x, x2: x, y1: y0, y2: y1 }));
      (this.upright ? beside : below)(this.to_screen(x, 0), tick_words(x, step), "plan-x");
    }
    for (const y of ticks(y0, y1, step)) {
      grid.append(svg("line", { y1: y, y2: y, x1: x0, x2: x1 }));
      (this.upright ? below : beside)(this.to_screen(0, y), tick_words(y, step), "plan-y");
    }
    const [across, up] = this.upright ? ["y [m]", "x [m]"] : ["x [m]", "y [m]"];
    words.append(svg("text", { x: this.width - margin.right - 4, y: bottom - 6, "text-anchor": "end", class: "axis-name", text: across }),
      svg("text", { x: inner.x + 5, y: inner.y + 14, class: "axis-name", text: up }));
    return { grid, words };
  }

  /** The lane as wide and as bent as it is; beside it, thin, lanes of the same width. */
  lane(inner) {
    const { road } = this.record, w = road.lane_width_m;
    if (!is_number(w)) return [];
    const corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([i, j]) => this.to_world(inner.x + i * inner.width, inner.y + j * inner.height).x);
    const from = Math.min(...corners) - 2, to = Math.max(...corners) + 2, step = road.curvature_1pm ? 1 : to - from;
    const line = (d, backwards = false) => {
      const points = [];
      for (let s = from; s <= to + 1e-9; s += step) { const p = from_lane(road, s, d); points.push(`${p.x.toFixed(4)} ${p.y.toFixed(4)}`); }
      return (backwards ? points.reverse() : points).join("L");
    };
    return [svg("path", { d: `M${line(-w / 2)}L${line(w / 2, true)}Z`, class: "lane-ground" }),
      svg("path", { d: `M${line(0)}`, class: "lane-centre" }),
      [-1.5, 1.5].map((n) => svg("path", { d: `M${line(n * w)}`, class: "lane-mark other" })),
      [-0.5, 0.5].map((n) => svg("path", { d: `M${line(n * w)}`, class: "lane-mark" }))];
  }

  line_through(track) {
    let d = "";
    list(track.x_m).forEach((x, k) => { if (is_number(x) && is_number(list(track.y_m)[k])) d += `${d ? "L" : "M"}${x} ${track.y_m[k]}`; });
    return d;
  }

  path() { return svg("path", { d: this.line_through(this.record), class: "path" }); }

  /** The draws: their paths, and where all of them ended with their headings. */
  fan() {
    const marks = this.ends().map((end) => {
      const h = radians(end.heading);
      return `M${end.x} ${end.y}l${(0.45 * Math.cos(h)).toFixed(4)} ${(0.45 * Math.sin(h)).toFixed(4)}`;
    });
    return svg("g", { class: "draws" }, list(this.record.draws?.paths).map((track) => svg("path", { d: this.line_through(track), class: "draw-path" })),
      marks.length ? [svg("path", { d: marks.join(""), class: "draw-heading" }), svg("path", { d: marks.map((m) => m.replace(/l.*/, "h0")).join(""), class: "draw-end" })] : []);
  }

  /** A car at a sample, in W. */
  car(k, pose) {
    const { record } = this, corners = this.corners(), to_d = (points) => `M${points.map((p) => p.join(" ")).join("L")}Z`;
    const radius = record.car.wheel_radius_m || 0.3;
    const wheels = record.wheels.map((wheel) => {
      if (!is_number(wheel.x_m) || !is_number(wheel.y_m)) return null;
      const locked = is_locked(record, wheel, k);
      return svg("g", { transform: `translate(${wheel.x_m} ${wheel.y_m}) rotate(${wheel.angle_deg[k] || 0})`, class: locked ? "wheel locked" : "wheel" },
        locked ? svg("circle", { r: 1.35 * radius }) : null,
        svg("rect", { x: -radius, y: -wheel_width / 2, width: 2 * radius, height: wheel_width }));
    });
    const body = [];
    if (corners.length) {
      const [front, half] = corners[0], rear = corners[1][0], at = (share) => rear + share * (front - rear);
      body.push(svg("path", { d: to_d(corners), class: "body" }),
        svg("path", { d: to_d([[at(0.71), 0.78 * half], [at(0.57), 0.68 * half], [at(0.57), -0.68 * half], [at(0.71), -0.78 * half]]), class: "glass" }),
        [-1, 1].map((side) => svg("path", { d: to_d([[at(0.985), 0.36], [at(0.985), 0.68], [at(0.945), 0.68], [at(0.945), 0.36]].map(([x, y]) => [x, side * y * half])), class: "lamp" })));
    }
    return svg("g", { transform: `translate(${pose.x} ${pose.y}) rotate(${pose.heading})`, class: "car" }, body, wheels);
  }

  /** Dots on the path at the ghosts, named by their times where there is room. */
  instants() {
    const group = svg("g", { class: "instants" });
    const taken = [];
    for (const { k, pose } of this.ghosts()) {
      const p = this.to_screen(pose.x, pose.y), at = { x: p.x, y: p.y - 7 };
      group.append(svg("circle", { cx: p.x, cy: p.y, r: 2.6 }));
      if (taken.some((q) => Math.abs(q.x - at.x) < 38 && Math.abs(q.y - at.y) < 14)) continue;
      taken.push(at);
      group.append(svg("text", { ...at, "text-anchor": "middle", text: num(this.record.time[k], 2, "s") }));
    }
    return group;
  }

  summary() {
    const { end } = this.record;
    return `Plan view: path of the centre of mass, ${num(end.forward_m, 2)} metres forward and ${sided(end.sideways_m, 2, "metres")}, ending at a heading of ${num(end.heading_deg, 1)} degrees`;
  }

  // --- what moves -----------------------------------------------------------------------------------

  show(k) {
    const pose = pose_at(this.record, k);
    if (!pose) { this.moving.replaceChildren(); return; }
    const car = this.car(k, pose);
    car.id = "car";
    const v = [this.record.v_x_mps[k], this.record.v_y_mps[k]];
    if (v.every(is_number) && this.record.speed[k] > sideslip_speed) {
      const tip = v.map((c) => c * arrow_seconds), way = Math.hypot(...tip), [c, s] = tip.map((x) => x / way), head = Math.min(0.35, 0.5 * way);
      const at = (a, b) => `${tip[0] + a * c - b * s} ${tip[1] + a * s + b * c}`;
      const shaft = `M0 0L${at(-head, 0)}`, tri = `M${at(0, 0)}L${at(-head, 0.45 * head)}L${at(-head, -0.45 * head)}Z`;
      car.append(svg("path", { d: shaft + tri, class: "velocity-halo" }), svg("path", { d: shaft, class: "velocity" }), svg("path", { d: tri, class: "velocity-head" }));
    }
    car.append(svg("circle", { r: 0.1, class: "mass" }));
    this.moving.replaceChildren(car);
  }
}
