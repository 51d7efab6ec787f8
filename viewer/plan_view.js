// The animated plan view. Draws what the record holds, to scale; the camera follows the ego along its lane.

const arrow_seconds = 0.5;  // how much of its way a velocity arrow shows
const trail_seconds = 2.5;
const risk_shown = 0.75;     // from here on an actor is drawn as a threat

class PlanView {
  constructor(canvas, record) {
    this.canvas = canvas;
    this.record = record;
    this.road = new RoadView(record.road);
    this.zoom = 1;
    this.ghost_preview = null;  // index
    this.ghost_policies = new Set();
    this.danger = new DangerLayer(record);
    this.hypotheses = new HypothesisLayer(record);
    this.read_colours();
    this.resize();
  }

  read_colours() {
    const style = getComputedStyle(document.documentElement);
    const names = ["ground", "paved", "road", "mark", "mark-soft", "kerb", "barrier", "tree", "ego", "ego-dark", "ego-line",
      "actor", "actor-line", "threat", "threat-line", "contact", "forecast", "hindsight", "hypothesis", "halo", "ink", "wheel", "glass"];
    this.colours = {};
    for (const name of names) this.colours[name.replace("-", "_")] = style.getPropertyValue(`--${name}`).trim();
    this.danger.read_colours(style);
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    this.width = Math.max(200, box.width);
    this.height = Math.max(150, box.height);
    this.ratio = Math.min(3, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(this.width * this.ratio);
    this.canvas.height = Math.round(this.height * this.ratio);
    this.upright = this.height > 0.8 * this.width;  // then forward is up, else to the right
    this.plan_zoom();
  }

  /** Scale for each frame so that whoever is near stays in view, smoothed over 1.5 s. */
  plan_zoom() {
    const long = this.upright ? this.height : this.width, wide = this.upright ? this.width : this.height;
    const wanted = this.record.frames.map((frame) => {
      const own = to_lane(this.road.road, { x: frame.ego.x_m, y: frame.ego.y_m });
      let scale = this.upright ? 10 : 18;
      for (const actor of list(frame.actors)) {
        const at = to_lane(this.road.road, { x: actor.x_m, y: actor.y_m });
        const ahead = at.s - own.s, aside = Math.abs(at.d - own.d);
        if (ahead < -16 || ahead > 70 || aside > 16) continue;
        scale = Math.min(scale, ahead > 0 ? (0.6 * long) / (ahead + 6) : (0.24 * long) / (6 - ahead), (0.44 * wide) / (aside + 2));
      }
      return Math.max(scale, this.upright ? 5 : 7);
    });
    const frames = this.record.frames;
    this.scales = wanted.map((_, k) => {
      let sum = 0, weight = 0;
      for (let j = k; j >= 0 && frames[k].t_s - frames[j].t_s < 0.75; j--) { sum += Math.log(wanted[j]); weight++; }
      for (let j = k + 1; j < frames.length && frames[j].t_s - frames[k].t_s < 0.75; j++) { sum += Math.log(wanted[j]); weight++; }
      return Math.exp(sum / weight);
    });
  }

  /** Where the camera stands: W point at the origin of the view, px/m, and the heading drawn as forward. */
  view(frame, t) {
    const ego = frame ? frame.ego : { x_m: this.road.road.x_m || 0, y_m: this.road.road.y_m || 0 };
    const own = to_lane(this.road.road, { x: ego.x_m, y: ego.y_m });
    const { left, right } = this.road.layout;
    const frames = this.record.frames;
    let scale = 10;
    if (frames.length) {
      const k = frame_index(frames, t), next = Math.min(k + 1, frames.length - 1);
      const share = next > k ? Math.min(1, (t - frames[k].t_s) / (frames[next].t_s - frames[k].t_s)) : 0;
      scale = mix(this.scales[k], this.scales[next], share);
    }
    scale *= this.zoom;
    const wide = (this.upright ? this.width : this.height) / scale;
    const middle = (Math.min(left, 9) + Math.max(right, -9)) / 2;
    const d = Math.min(Math.max(middle, own.d - 0.35 * wide), own.d + 0.35 * wide);
    const centre = from_lane(this.road.road, own.s, d);
    return { x: centre.x, y: centre.y, heading: centre.heading, scale, s: own.s,
      px: this.upright ? this.width / 2 : 0.3 * this.width, py: this.upright ? 0.7 * this.height : this.height / 2 };
  }

  /** World to CSS pixels of the canvas. */
  to_screen(view, x, y) {
    const dx = x - view.x, dy = y - view.y, c = Math.cos(view.heading), s = Math.sin(view.heading);
    const forward = view.scale * (dx * c + dy * s), left = view.scale * (-dx * s + dy * c);
    return this.upright ? { x: view.px - left, y: view.py - forward } : { x: view.px + forward, y: view.py - left };
  }

  world_units(g, view) {
    const o = this.to_screen(view, 0, 0), x = this.to_screen(view, 1, 0), y = this.to_screen(view, 0, 1), r = this.ratio;
    g.setTransform(r * (x.x - o.x), r * (x.y - o.y), r * (y.x - o.x), r * (y.y - o.y), r * o.x, r * o.y);
  }

  pixel_units(g) { g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0); }

  draw(t) {
    const g = this.canvas.getContext("2d"), frame = frame_at(this.record, t), view = this.view(frame, t);
    this.last_view = view;
    this.labels = [];
    this.pixel_units(g);
    g.fillStyle = this.colours.ground;
    g.fillRect(0, 0, this.width, this.height);
    this.world_units(g, view);
    const reach = (this.width + this.height) / view.scale;
    this.road.draw(g, this.colours, view.s - reach, view.s + reach);
    if (frame) this.draw_bodies(g, frame, view, t);
    this.pixel_units(g);
    this.scale_bar(g, view);
  }

  draw_bodies(g, frame, view, t) {
    this.danger.draw(g, frame, t, 1 / view.scale);
    this.trails(g, t, view);
    this.paths(g, t, view);
    this.hypotheses.draw(g, t, 1 / view.scale, this.colours.hypothesis, (...body) => this.outline(...body));
    for (const actor of list(frame.actors)) this.velocity(g, actor, view);
    this.velocity(g, { ...frame.ego, heading_deg: frame.ego.heading_deg + (frame.ego.sideslip_deg || 0) }, view, true);
    for (const actor of list(frame.actors)) this.actor(g, actor, view);
    this.ego(g, frame.ego);
    this.centre_of_mass(g, frame, t, view);
    this.forecast(g, t, view, frame);
    this.contact(g, t, view);
    this.pixel_units(g);
    this.cues(view);
    this.strangers(g, frame, view);
    this.write_labels(g);
  }

  // --- bodies -------------------------------------------------------------------------------------

  outline(g, body, shape, centre = 0) {
    const h = radians(body.heading_deg || 0), c = Math.cos(h), s = Math.sin(h);
    const at = (a, b) => [body.x_m + a * c - b * s, body.y_m + a * s + b * c];
    const l = (shape.length_m || 1) / 2, w = (shape.width_m ?? 1) / 2;
    g.beginPath();
    if (shape.shape === "ellipse") g.ellipse(body.x_m, body.y_m, l, w, h, 0, 2 * Math.PI);
    else for (const [a, b] of [[l, w], [-l, w], [-l, -w], [l, -w]]) g.lineTo(...at(centre + a, b));
    g.closePath();
    return at;
  }

  polygon(g, at, points, colour) {
    g.beginPath();
    for (const [a, b] of points) g.lineTo(...at(a, b));
    g.closePath();
    g.fillStyle = colour;
    g.fill();
  }

  ego(g, body) {
    const shape = this.record.ego, centre = shape.centre_x_m || 0;
    const at = this.outline(g, body, shape, centre);
    g.fillStyle = this.colours.ego;
    g.fill();
    g.lineWidth = 0.1;
    g.strokeStyle = this.colours.ego_line;
    g.stroke();
    const l = (shape.length_m || 4.5) / 2, w = (shape.width_m || 1.8) / 2;
    this.polygon(g, at, [[centre + 0.42 * l, 0.78 * w], [centre + 0.14 * l, 0.68 * w], [centre + 0.14 * l, -0.68 * w], [centre + 0.42 * l, -0.78 * w]], this.colours.glass);
    this.polygon(g, at, [[centre - 0.62 * l, 0.66 * w], [centre - 0.74 * l, 0.72 * w], [centre - 0.74 * l, -0.72 * w], [centre - 0.62 * l, -0.66 * w]], this.colours.glass);
    this.polygon(g, at, [[centre + 0.92 * l, 0], [centre + 0.62 * l, 0.3 * w], [centre + 0.62 * l, -0.3 * w]], this.colours.halo);
    this.wheels(g, at, shape, body.steering_deg || 0);
  }

  /** The place that the danger map is about: red where that is red. */
  centre_of_mass(g, frame, t, view) {
    const value = this.danger.value(frame, t, frame.ego), px = 1 / view.scale;
    if (value === null) return;
    g.beginPath();
    g.arc(frame.ego.x_m, frame.ego.y_m, 4 * px, 0, 2 * Math.PI);
    g.fillStyle = value >= 0 ? this.colours.contact : this.colours.ego_dark;
    g.fill();
    g.lineWidth = 1.5 * px;
    g.strokeStyle = this.colours.halo;
    g.stroke();
  }

  wheels(g, at, shape, steering_deg) {
    const track = shape.track_m;
    if (!is_number(track) || !is_number(shape.front_axle_x_m) || !is_number(shape.rear_axle_x_m)) return;
    for (const [axle, turn] of [[shape.front_axle_x_m, radians(steering_deg)], [shape.rear_axle_x_m, 0]]) {
      for (const side of [-track / 2, track / 2]) {
        const c = Math.cos(turn), s = Math.sin(turn);
        const corners = [[0.34, 0.12], [-0.34, 0.12], [-0.34, -0.12], [0.34, -0.12]].map(([a, b]) => [axle + a * c - b * s, side + a * s + b * c]);
        this.polygon(g, at, corners, this.colours.wheel);
      }
    }
  }

  is_threat(id) { return (this.record.risk_of.get(id) ?? 0) >= risk_shown || this.record.result.contact?.with === id; }

  actor(g, body, view) {
    const shape = this.record.shape_of.get(body.id) || { shape: "ellipse", length_m: 1, width_m: 1 };
    const threat = this.is_threat(body.id);
    const at = this.outline(g, body, shape);
    g.fillStyle = threat ? this.colours.threat : this.colours.actor;
    g.fill();
    g.lineWidth = threat ? 0.14 : 0.08;
    g.strokeStyle = threat ? this.colours.threat_line : this.colours.actor_line;
    g.stroke();
    const l = shape.length_m / 2, w = shape.width_m / 2;
    if (shape.shape !== "ellipse" && shape.kind !== "obstacle" && shape.length_m > 3) {
      this.polygon(g, at, [[0.5 * l, 0.75 * w], [0.3 * l, 0.66 * w], [0.3 * l, -0.66 * w], [0.5 * l, -0.75 * w]], this.colours.glass);
    }
    const p = this.to_screen(view, body.x_m, body.y_m);
    this.labels.push({ ...p, text: String(body.id), reach: (Math.max(w, 0.4) * view.scale) + 4, weight: threat ? 2 : 1, colour: this.colours.ink, bold: threat });
  }

  velocity(g, body, view, own = false) {
    if (!is_number(body.speed_mps) || Math.abs(body.speed_mps) < 0.3) return;
    const way = body.speed_mps * arrow_seconds, h = radians(body.heading_deg || 0), c = Math.cos(h), s = Math.sin(h);
    const px = 1 / view.scale, head = 8 * px;
    const tip = [body.x_m + way * c, body.y_m + way * s], neck = [tip[0] - head * c, tip[1] - head * s];
    g.strokeStyle = g.fillStyle = own ? this.colours.ego_dark : this.is_threat(body.id) ? this.colours.threat_line : this.colours.actor_line;
    g.lineWidth = (own ? 2.2 : 1.6) * px;
    g.beginPath();
    g.moveTo(body.x_m, body.y_m);
    g.lineTo(...neck);
    g.stroke();
    g.beginPath();
    g.moveTo(...tip);
    g.lineTo(neck[0] - 0.45 * head * s, neck[1] + 0.45 * head * c);
    g.lineTo(neck[0] + 0.45 * head * s, neck[1] - 0.45 * head * c);
    g.fill();
  }

  trails(g, t, view) {
    const frames = this.record.frames, last = frame_index(frames, t), before = new Map();
    g.lineWidth = 2 / view.scale;
    for (let k = last; k >= 0 && t - frames[k].t_s < trail_seconds; k -= 1) {
      if (k !== last && k % 4) continue;
      g.globalAlpha = 0.55 * (1 - (t - frames[k].t_s) / trail_seconds);
      for (const [id, body] of [["", frames[k].ego], ...list(frames[k].actors).map((a) => [a.id, a])]) {
        const old = before.get(id);
        if (old) {
          g.strokeStyle = id === "" ? this.colours.ego : this.is_threat(id) ? this.colours.threat : this.colours.actor_line;
          g.beginPath();
          g.moveTo(old.x_m, old.y_m);
          g.lineTo(body.x_m, body.y_m);
          g.stroke();
        }
        before.set(id, body);
      }
    }
    g.globalAlpha = 1;
  }

  // --- overlays -----------------------------------------------------------------------------------

  paths(g, t, view) {
    const px = 1 / view.scale;
    for (const row of this.record.hindsight) {
      const path = list(row.path);
      if (!this.ghost_policies.has(row.policy) || path.length < 2) continue;
      g.strokeStyle = this.colours.hindsight;
      g.lineWidth = 2 * px;
      g.setLineDash([7 * px, 4 * px]);
      g.beginPath();
      for (const [x, y] of path) g.lineTo(x, y);
      g.stroke();
      const since = is_number(this.record.t1) ? t - this.record.t1 : -1;
      if (since >= 0) {
        const k = Math.min(since / 0.05, path.length - 1), i = Math.floor(k), next = path[Math.min(i + 1, path.length - 1)];
        const share = k - i;
        this.outline(g, { x_m: mix(path[i][0], next[0], share), y_m: mix(path[i][1], next[1], share), heading_deg: mix_angle(path[i][2], next[2], share) },
          this.record.ego, this.record.ego.centre_x_m || 0);
        g.stroke();
      }
      g.setLineDash([]);
      const end = path[path.length - 1], p = this.to_screen(view, end[0], end[1]);
      this.labels.push({ ...p, text: `${row.name}${row.contact ? " ✕" : ""}`, reach: 8, weight: 3, colour: this.colours.hindsight, bold: true });
    }
  }

  forecast(g, t, view, frame) {
    const preview = this.record.previews[this.ghost_preview];
    if (!preview?.scene || (is_number(this.record.t2) && t < this.record.t2)) return;
    const px = 1 / view.scale;
    g.strokeStyle = this.colours.forecast;
    g.lineWidth = 2 * px;
    g.setLineDash([5 * px, 3 * px]);
    const bodies_now = new Map([["", frame.ego], ...list(frame.actors).map((a) => [a.id, a])]);
    const bodies = [[preview.scene.ego, { ...this.record.ego }, "ego at T1"], ...list(preview.scene.actors).map((a) => [a, this.record.shape_of.get(a.id), `${a.id} at T1`])];
    for (const [body, shape, name] of bodies) {
      if (!body || !shape || !is_number(body.x_m)) continue;
      this.outline(g, body, shape, shape.centre_x_m || 0);
      g.stroke();
      const p = this.to_screen(view, body.x_m, body.y_m), now = bodies_now.get(body.id ?? "");
      if (now && Math.hypot(now.x_m - body.x_m, now.y_m - body.y_m) < 2.5) continue;  // it stands on its body: no second name
      this.labels.push({ ...p, text: name, reach: -(shape.width_m / 2) * view.scale - 5, weight: 0, colour: this.colours.forecast });
    }
    g.setLineDash([]);
  }

  contact(g, t, view) {
    const contact = this.record.result.contact;
    if (!contact || !is_number(contact.x_m) || t < contact.time_s - 1e-6) return;
    const size = 13 / view.scale;
    for (const [grow, colour] of [[1.35, this.colours.halo], [1, this.colours.contact]]) {
      g.beginPath();
      for (let k = 0; k < 20; k++) {
        const r = grow * size * (k % 2 ? 0.5 : 1), a = (k * Math.PI) / 10;
        g.lineTo(contact.x_m + r * Math.cos(a), contact.y_m + r * Math.sin(a));
      }
      g.closePath();
      g.fillStyle = colour;
      g.fill();
    }
    const p = this.to_screen(view, contact.x_m, contact.y_m);
    this.labels.push({ ...p, text: `contact ${num(contact.relative_speed_mps, 1, "m/s")}`, reach: -26, weight: 9, colour: this.colours.contact, bold: true });
  }

  /** What the place tells of, without being seen. */
  cues(view) {
    for (const cue of list(this.record.cues)) {
      const p = this.to_screen(view, cue.x_m, cue.y_m);
      this.labels.push({ ...p, text: `⚠ ${String(cue.kind).replaceAll("_", " ")}`, reach: 0, weight: 4, colour: this.colours.threat_line });
    }
  }

  /** Threats outside the picture are named at its border. */
  strangers(g, frame, view) {
    for (const actor of list(frame.actors)) {
      if (!this.is_threat(actor.id)) continue;
      const p = this.to_screen(view, actor.x_m, actor.y_m), margin = 16;
      const x = Math.min(Math.max(p.x, margin), this.width - margin), y = Math.min(Math.max(p.y, margin), this.height - margin);
      const shape = this.record.shape_of.get(actor.id), half = ((shape?.length_m || 1) / 2) * view.scale;
      if (Math.hypot(p.x - x, p.y - y) < half + margin) continue;  // part of it is in the picture
      const a = Math.atan2(p.y - y, p.x - x);
      g.beginPath();
      for (const [r, turn] of [[9, 0], [7, 2.4], [7, -2.4]]) g.lineTo(x + r * Math.cos(a + turn), y + r * Math.sin(a + turn));
      g.closePath();
      g.fillStyle = this.colours.threat_line;
      g.fill();
      this.labels.push({ x: Math.min(Math.max(x, 40), this.width - 40), y, text: actor.id, reach: y < 40 ? -12 : 12, weight: 5, colour: this.colours.ink, bold: true });
    }
  }

  /** Names beside their bodies, the weightier first; one that would cover another is left out. */
  write_labels(g) {
    const taken = [];
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.lineJoin = "round";
    for (const label of this.labels.sort((a, b) => b.weight - a.weight)) {
      g.font = `${label.bold ? 600 : 400} 12px system-ui, sans-serif`;
      const half = g.measureText(label.text).width / 2 + 3;
      const seen = label.x > 0 && label.x < this.width;
      const x = seen ? Math.min(Math.max(label.x, half + 2), this.width - half - 2) : label.x, y = label.y + (label.reach >= 0 ? -label.reach - 7 : -label.reach + 7);
      if (x + half < 0 || x - half > this.width || y < 4 || y > this.height - 4) continue;
      if (taken.some((b) => Math.abs(b.x - x) < b.half + half && Math.abs(b.y - y) < 14)) continue;
      taken.push({ x, y, half });
      g.lineWidth = 3.5;
      g.strokeStyle = this.colours.halo;
      g.strokeText(label.text, x, y);
      g.fillStyle = label.colour;
      g.fillText(label.text, x, y);
    }
  }

  scale_bar(g, view) {
    const length = [1, 2, 5, 10, 20, 50, 100].find((m) => m * view.scale >= 70) || 100;
    const x = 14, y = this.height - 14, end = x + length * view.scale;
    g.strokeStyle = g.fillStyle = this.colours.ink;
    g.lineWidth = 2;
    g.beginPath();
    g.moveTo(x, y - 5); g.lineTo(x, y); g.lineTo(end, y); g.lineTo(end, y - 5);
    g.stroke();
    g.font = "12px system-ui, sans-serif";
    g.textAlign = "center";
    g.textBaseline = "bottom";
    g.lineWidth = 3.5;
    g.strokeStyle = this.colours.halo;
    g.strokeText(`${length} m`, (x + end) / 2, y - 4);
    g.fillText(`${length} m`, (x + end) / 2, y - 4);
  }
}
