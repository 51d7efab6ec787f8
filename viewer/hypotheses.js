// What the others may do, as a verdict took it to be: outlines in the plan view, the darker the likelier.

const ghost_seconds = [0, 1, 2];  // after the cursor: when a ghost's outline is drawn, ever fainter

/** Of a path: whole numbers, one text for each coordinate; null where they do not fit together. */
function read_path(raw) {
  const numbers = (text) => String(text ?? "").split(" ").map(Number), given = dict(raw);
  const x = numbers(given.x_cm), y = numbers(given.y_cm), heading = numbers(given.heading_deg);
  if (typeof given.x_cm !== "string" || x.length !== y.length || x.length !== heading.length || ![...x, ...y, ...heading].every(Number.isFinite)) return null;
  return { id: String(given.id), poses: x.map((cm, k) => ({ x_m: cm / 100, y_m: y[k] / 100, heading_deg: heading[k] })) };
}

/** Sets of hypotheses by time, each with paths that can be drawn. */
function read_hypotheses(raw) {
  return list(raw).map(dict).filter((one) => [one.t_s, one.scene_s, one.step_s, one.horizon_s].every(is_number) && one.step_s > 0).map((one) => ({
    ...one, reacting: list(one.reacting).map(String),
    motions: list(one.motions).map(dict).filter((motion) => is_number(motion.probability) && motion.probability > 0)
      .map((motion) => ({ probability: Math.min(1, motion.probability), paths: list(motion.paths).map(read_path).filter(Boolean) })) })).sort((a, b) => a.t_s - b.t_s);
}

class HypothesisLayer {
  constructor(record) {
    this.sets = record.hypotheses;
    this.record = record;
    this.shown = null;  // index
  }

  /** Where a path is `since` seconds after the judged scene; null: beyond what the record holds. */
  pose(set, path, since) {
    if (since < -1e-9 || since > set.horizon_s + 1e-9) return null;
    const k = Math.min(Math.max(since / set.step_s, 0), path.poses.length - 1), a = path.poses[Math.floor(k)], b = path.poses[Math.ceil(k)], share = k - Math.floor(k);
    return { x_m: mix(a.x_m, b.x_m, share), y_m: mix(a.y_m, b.y_m, share), heading_deg: mix_angle(a.heading_deg, b.heading_deg, share) };
  }

  /** Sixteen draws that agree are together as dark as one that is sure. */
  static opacity(probability) { return 1 - (1 - 0.85) ** probability; }

  /** On a canvas in metres of W. */
  draw(g, t, px, colour, outline) {
    const set = this.sets[this.shown];
    if (!set || t < set.scene_s - 1e-9) return;
    g.strokeStyle = g.fillStyle = colour;
    for (const motion of set.motions) {
      const dark = HypothesisLayer.opacity(motion.probability);
      for (const path of motion.paths) this.draw_path(g, set, path, t - set.scene_s, dark, px, outline);
    }
    g.globalAlpha = 1;
  }

  draw_path(g, set, path, since, dark, px, outline) {
    const shape = this.record.shape_of.get(path.id) ?? { shape: "ellipse", length_m: 1, width_m: 1 };
    g.globalAlpha = Math.min(1, 2.5 * dark);
    g.lineWidth = 1.4 * px;
    g.beginPath();
    for (const pose of path.poses) g.lineTo(pose.x_m, pose.y_m);
    g.stroke();
    ghost_seconds.forEach((later, k) => {
      const pose = this.pose(set, path, since + later);
      if (!pose || (k > 0 && path.poses.length === 1)) return;
      outline(g, pose, shape);
      g.globalAlpha = dark / (1 + k);
      g.fill();
      g.globalAlpha = Math.min(1, (2.5 * dark) / (1 + k));
      g.lineWidth = 1 * px;
      g.stroke();
    });
  }
}

/** What a set is called where one is chosen. */
const hypotheses_name = (record, set) => (is_number(record.t1) && Math.abs(set.t_s - record.t1) < 1e-9 ? "T1" : `switch ${signed(set.t_s - (record.t1 ?? 0))}\u00A0s`);

/** What a set is, in words; of none, what hypotheses are. */
function hypotheses_words(set) {
  if (!set) return "hypotheses: what the others may do";
  const many = set.motions.length, reacting = set.reacting.length ? `; ${set.reacting.join(", ")} behind ${set.reacting.length > 1 ? "react" : "reacts"} to the ego and ${set.reacting.length > 1 ? "are" : "is"} not drawn` : "";
  return `${many} ${many === 1 ? "way" : "ways"} in which the others may move on from ${num(set.scene_s, 2, "s")}, darker where likelier; outlines now, 1 and 2 s later${reacting}`;
}

/** Chooses a set, steps through them, or shows none; nothing where the record holds none. */
function hypothesis_switch(record, choose) {
  const sets = record.hypotheses;
  if (!sets.length) return [];
  const select = el("select", { id: "hypotheses", onchange: (e) => choose(e.target.value === "" ? null : Number(e.target.value)) },
    [["", "none"], ...sets.map((set, k) => [String(k), hypotheses_name(record, set)])].map(([value, text]) => el("option", { value, text })));
  const step = (by) => () => choose(select.value === "" ? (by > 0 ? 0 : sets.length - 1) : (Number(select.value) + by + sets.length) % sets.length);
  return [el("label", { class: "field", for: "hypotheses" }, el("i", { class: "swatch hypothesis", "aria-hidden": "true" }), "Hypotheses"),
    el("div", { class: "field stepper" }, el("button", { type: "button", id: "hypotheses-back", "aria-label": "Hypotheses of the plan begun before", text: "\u2039", onclick: step(-1) }), select,
      el("button", { type: "button", id: "hypotheses-forth", "aria-label": "Hypotheses of the plan begun next", text: "\u203A", onclick: step(1) }))];
}
