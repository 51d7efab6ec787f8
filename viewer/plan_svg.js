// Small plan views as SVG: road and bodies to scale, with some direction of W pointing to the right.

/** Corners of a body's outline or of a part of it, in W; `parts` in half lengths and half widths of the body. */
function body_points(pose, shape, parts = [[1, 1], [-1, 1], [-1, -1], [1, -1]]) {
  const h = radians(pose.heading_deg || 0), c = Math.cos(h), s = Math.sin(h), centre = shape.centre_x_m || 0;
  const l = (shape.length_m || 1) / 2, w = (is_number(shape.width_m) ? shape.width_m : 1) / 2;
  return parts.map(([a, b]) => ({ x: pose.x_m + (centre + a * l) * c - b * w * s, y: pose.y_m + (centre + a * l) * s + b * w * c }));
}

const has_pose = (pose) => Boolean(pose) && is_number(pose.x_m) && is_number(pose.y_m);

/** A pose of a path ([x_m, y_m, heading_deg] every 50 ms) `since` seconds after its start; ends are held. */
function pose_on(path, since) {
  const k = Math.min(Math.max(since / path_seconds, 0), path.length - 1), a = path[Math.floor(k)], b = path[Math.ceil(k)];
  const share = k - Math.floor(k);
  return { x_m: mix(a[0], b[0], share), y_m: mix(a[1], b[1], share), heading_deg: mix_angle(a[2], b[2], share) };
}

const path_seconds = 0.05;

class PlanSvg {
  /**
   * @param origin  pose whose heading points to the right [m, deg]
   * @param ground  { low: {x, y}, high: {x, y} } of what is shown, in the origin's frame [m]
   */
  constructor(road, origin, ground, width, height) {
    Object.assign(this, { road, origin, width, height, nodes: [] });
    this.scale = Math.min(width / (ground.high.x - ground.low.x), height / (ground.high.y - ground.low.y));
    this.middle = { x: (ground.low.x + ground.high.x) / 2, y: (ground.low.y + ground.high.y) / 2 };
    this.reach = (width + height) / this.scale;
  }

  /** Frame of the origin: forward, left. */
  static local(origin, p) {
    const h = radians(origin.heading_deg || 0), c = Math.cos(h), s = Math.sin(h), x = p.x - origin.x_m, y = p.y - origin.y_m;
    return { x: x * c + y * s, y: -x * s + y * c };
  }

  px(p) {
    const local = PlanSvg.local(this.origin, p);
    return { x: this.width / 2 + this.scale * (local.x - this.middle.x), y: this.height / 2 - this.scale * (local.y - this.middle.y) };
  }

  text_of(points) { return points.map((p) => this.px(p)).map((p) => `${p.x.toFixed(1)},${p.y.toFixed(1)}`).join(" "); }
  add(...nodes) { this.nodes.push(...nodes.flat(Infinity).filter(Boolean)); }
  polygon(kind, points, more = {}) { this.add(svg("polygon", { class: kind, points: this.text_of(points), ...more })); }
  polyline(kind, points, more = {}) { this.add(svg("polyline", { class: kind, points: this.text_of(points), ...more })); }

  picture(label) {
    return svg("svg", { class: "plan-svg", viewBox: `0 0 ${this.width} ${this.height}`, role: "img", "aria-label": label }, this.nodes);
  }

  // --- the road -----------------------------------------------------------------------------------

  draw_road() {
    const { left, right, width, lanes_left, lanes_right } = lane_layout(this.road), crossing = this.road.topology === "intersection";
    this.add(svg("rect", { class: crossing ? "paved" : "ground", width: this.width, height: this.height }));
    const own = to_lane(this.road, { x: this.origin.x_m, y: this.origin.y_m }).s, bend = Math.abs(this.road.curvature_1pm || 0);
    const reach = bend ? Math.min(this.reach, 2.8 / bend) : this.reach, step = bend ? 2 : reach;
    this.stations = [];
    for (let s = own - reach; s <= own + reach + 1e-6; s += step) this.stations.push(s);
    this.polygon("road", [...this.along(right), ...this.along(left).reverse()]);
    for (let n = -lanes_right; n <= lanes_left + 1; n++) {
      const d = (n - 0.5) * width, outer = n === -lanes_right || n === lanes_left + 1;
      const oncoming = !outer && ((n === 1 && this.road.oncoming_left) || (n === 0 && this.road.oncoming_right));
      if (oncoming) for (const side of [-0.2, 0.2]) this.polyline("mark", this.along(d + side));
      else this.polyline(outer ? "mark" : "mark dashes", this.along(outer ? Math.min(Math.max(d, right + 0.15), left - 0.15) : d));
    }
    this.draw_beyond(this.road.left_beyond, left, 1);
    this.draw_beyond(this.road.right_beyond, right, -1);
  }

  along(d) { return this.stations.map((s) => from_lane(this.road, s, d)); }

  draw_beyond(what, edge, side) {
    if (what === "kerb") this.polygon("kerb", [...this.along(edge), ...this.along(edge + 0.45 * side).reverse()]);
    if (what === "barrier") this.polyline("barrier", this.along(edge + 0.3 * side));
    if (what !== "trees") return;
    const first = this.stations[0], last = this.stations[this.stations.length - 1];
    for (let k = Math.ceil(first / 5); k * 5 < last; k++) {
      const p = this.px(from_lane(this.road, k * 5, edge + side * (2.4 + 1.6 * Math.abs(Math.sin(12.9898 * k)))));
      if (p.x > -20 && p.x < this.width + 20 && p.y > -20 && p.y < this.height + 20) this.add(svg("circle", { class: "tree", cx: p.x.toFixed(1), cy: p.y.toFixed(1), r: (1.4 * this.scale).toFixed(1) }));
    }
  }

  // --- bodies -------------------------------------------------------------------------------------

  body(kind, pose, shape, more = {}) {
    if (!has_pose(pose)) return;
    if (shape.shape !== "ellipse") {
      this.polygon(kind, body_points(pose, shape), more);
      return;
    }
    const p = this.px({ x: pose.x_m, y: pose.y_m }), turn = (this.origin.heading_deg || 0) - (pose.heading_deg || 0);
    this.add(svg("ellipse", { class: kind, cx: p.x.toFixed(1), cy: p.y.toFixed(1), rx: (this.scale * (shape.length_m || 1) / 2).toFixed(1),
      ry: (this.scale * (shape.width_m || 1) / 2).toFixed(1), transform: `rotate(${turn.toFixed(1)} ${p.x.toFixed(1)} ${p.y.toFixed(1)})`, ...more }));
  }

  windscreen(pose, shape) {
    if (has_pose(pose) && shape.shape !== "ellipse" && shape.kind !== "obstacle" && (shape.length_m || 0) > 3) {
      const back = Math.max(0.25, 1 - 3.8 / shape.length_m), front = Math.max(0.48, 1 - 2.6 / shape.length_m);
      this.polygon("glass", body_points(pose, shape, [[front, 0.74], [back, 0.62], [back, -0.62], [front, -0.74]]));
    }
  }

  star(x, y, size) {
    const p = this.px({ x, y }), points = [];
    for (let k = 0; k < 16; k++) {
      const r = size * (k % 2 ? 0.45 : 1), a = (k * Math.PI) / 8;
      points.push(`${(p.x + r * Math.cos(a)).toFixed(1)},${(p.y + r * Math.sin(a)).toFixed(1)}`);
    }
    this.add(svg("polygon", { class: "star", points: points.join(" ") }));
  }

  /** An arrow from a point of W, `way` along a direction of W [px]. */
  arrow(kind, p, direction_deg, way) {
    const from = this.px(p), turn = radians(direction_deg - (this.origin.heading_deg || 0)), c = Math.cos(turn), s = -Math.sin(turn);
    const tip = { x: from.x + way * c, y: from.y + way * s }, neck = { x: tip.x - 9 * c, y: tip.y - 9 * s };
    const word = (q) => `${q.x.toFixed(1)},${q.y.toFixed(1)}`;
    const line = { x1: from.x.toFixed(1), y1: from.y.toFixed(1), x2: neck.x.toFixed(1), y2: neck.y.toFixed(1) };
    this.add(svg("line", { class: "arrow-halo", ...line }), svg("line", { class: `arrow ${kind}`, ...line }),
      svg("polygon", { class: `arrow-head ${kind}`, points: [tip, { x: neck.x - 4 * s, y: neck.y + 4 * c }, { x: neck.x + 4 * s, y: neck.y - 4 * c }].map(word).join(" ") }));
    return tip;
  }

  label(text, x, y, kind = "", anchor = "middle") {
    this.add(svg("text", { class: `on-svg ${kind}`, x: x.toFixed(1), y: y.toFixed(1), "text-anchor": anchor, text }));
  }

  scale_bar() {
    const length = [1, 2, 5, 10, 20, 50].find((m) => m * this.scale >= 36) || 50, y = this.height - 8, end = 9 + length * this.scale;
    this.add(svg("polyline", { class: "scale", points: `9,${y - 4} 9,${y} ${end.toFixed(1)},${y} ${end.toFixed(1)},${y - 4}` }));
    this.label(`${length} m`, end + 5, y + 1, "", "start");
  }
}
