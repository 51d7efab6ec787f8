// What each of the eight policies would have led to: small plan views of the same ground, and their cost as bars.

const most_ahead = 80;  // without contact a picture does not reach farther [m]

/** When hindsight begins. */
const hindsight_start = (record) => record.decision?.time_s ?? record.t1;

/**
 * Poses of the others `since` seconds after the trigger: as this policy would have moved them, else as they were recorded. `stale`: that is
 * after the last frame, and where they went then is not known.
 */
function others_at(record, row, since) {
  const told = new Map(list(row.others).filter((one) => list(one.path).length).map((one) => [one.id, one.path]));
  const start = hindsight_start(record), frame = is_number(start) ? frame_at(record, start + since) : null;
  const stale = is_number(start) && start + since > record.frames[record.frames.length - 1]?.t_s + 0.02;
  const poses = new Map(list(frame?.actors).map((actor) => [actor.id, { ...actor, stale }]));
  for (const [id, path] of told) poses.set(id, { id, ...pose_on(path, since) });
  return [...poses.values()].filter(has_pose);
}

const contacts_of = (row) => [row.contact, ...list(row.later)].filter((contact) => contact && is_number(contact.x_m) && is_number(contact.y_m));

/** How long a policy's picture goes on [s]. */
function future_length(record, row) {
  const start = hindsight_start(record), last = contacts_of(row).map((contact) => (contact.time_s || 0) - start).filter(is_number);
  return Math.max(0, (list(row.path).length - 1) * path_seconds, ...last);
}

/** Times of the outlines: every quarter of a second, fewer of a long way. */
function ghost_times(length) {
  const step = length <= 2.5 ? 0.25 : length <= 5 ? 0.5 : 1, times = [];
  for (let k = 0; k * step < length - 1e-6; k++) times.push(k * step);
  return times;
}

class Ground {
  low = { x: Infinity, y: Infinity };
  high = { x: -Infinity, y: -Infinity };

  add(p) {
    this.low = { x: Math.min(this.low.x, p.x), y: Math.min(this.low.y, p.y) };
    this.high = { x: Math.max(this.high.x, p.x), y: Math.max(this.high.y, p.y) };
  }
  grown(x, y) { return Object.assign(new Ground(), { low: { x: this.low.x - x, y: this.low.y - y }, high: { x: this.high.x + x, y: this.high.y + y } }); }
  meets(other) { return this.low.x <= other.high.x && other.low.x <= this.high.x && this.low.y <= other.high.y && other.low.y <= this.high.y; }
  nearest(p) { return { x: Math.min(Math.max(p.x, this.low.x), this.high.x), y: Math.min(Math.max(p.y, this.low.y), this.high.y) }; }
}

/** The ground that shows what happens under all policies, in the frame of `origin`. */
function common_ground(record, rows, origin) {
  const ground = new Ground(), local = (p) => PlanSvg.local(origin, p), box_of = (pose, shape) => {
    const box = new Ground();
    for (const p of body_points(pose, shape)) box.add(local(p));
    return box;
  };
  for (const row of rows) {
    const last = Math.max(-1, ...contacts_of(row).map((contact) => contact.time_s - hindsight_start(record)));
    list(row.path).forEach((_, k) => {
      const box = box_of(pose_on(row.path, k * path_seconds), record.ego);
      if (k * path_seconds <= last || box.high.x < most_ahead) { ground.add(box.low); ground.add(box.high); }
    });
    for (const contact of contacts_of(row)) ground.add(local({ x: contact.x_m, y: contact.y_m }));
  }
  const near = ground.grown(9, 6);
  for (const row of rows) {
    for (const since of [...ghost_times(future_length(record, row)), future_length(record, row)]) {
      for (const pose of others_at(record, row, since)) {
        const box = box_of(pose, record.shape_of.get(pose.id) ?? {});
        if (box.meets(near)) { ground.add(near.nearest(box.low)); ground.add(near.nearest(box.high)); }
      }
    }
  }
  return ground.grown(2, 1.5);
}

const picture_width = 340;  // [px]

/** As high as what is shown asks for, within limits; the same for all. */
function picture_height(ground) {
  return Math.round(Math.min(210, Math.max(96, (picture_width * (ground.high.y - ground.low.y)) / (ground.high.x - ground.low.x))));
}

function draw_future(record, row, origin, ground) {
  const plan = new PlanSvg(record.road, origin, ground, picture_width, picture_height(ground)), path = list(row.path), length = future_length(record, row);
  const kind_of = (id) => (contacts_of(row).some((contact) => contact.with === id) ? "threat" : "actor");
  const shape_of = (id) => record.shape_of.get(id) ?? { shape: "ellipse", length_m: 1, width_m: 1 };
  plan.draw_road();
  plan.polyline("trail ego", path.map(([x, y]) => ({ x, y })));
  for (const since of ghost_times(length)) {
    const look = { "stroke-opacity": (0.25 + (0.6 * since) / length).toFixed(2), "fill-opacity": (0.05 + (0.2 * since) / length).toFixed(2) };
    for (const pose of others_at(record, row, since)) if (!pose.stale) plan.body(`ghost ${kind_of(pose.id)}`, pose, shape_of(pose.id), look);
    if (path.length) plan.body("ghost ego", pose_on(path, since), record.ego, look);
  }
  for (const pose of others_at(record, row, length)) {
    plan.body(`body ${kind_of(pose.id)}${pose.stale ? " stale" : ""}`, pose, shape_of(pose.id));
    if (!pose.stale) plan.windscreen(pose, shape_of(pose.id));
  }
  const end = path.length ? pose_on(path, length) : origin;
  plan.body("body ego", end, record.ego);
  plan.windscreen(end, record.ego);
  contacts_of(row).reverse().forEach((contact, k, all) => plan.star(contact.x_m, contact.y_m, k === all.length - 1 ? 8 : 5));
  plan.scale_bar();
  return plan;
}

/** Cards, one per policy; refused ones show where all begin. */
function show_futures(record) {
  const panel = by_id("futures"), rows = record.hindsight, start = hindsight_start(record);
  const first = is_number(start) ? frame_at(record, start)?.ego : null;
  if (!rows.length || !has_pose(first)) {
    panel.append(el("p", { class: "soft", text: "The record holds no hindsight." }));
    return;
  }
  const lane = from_lane(record.road, to_lane(record.road, { x: first.x_m, y: first.y_m }).s, 0);
  const origin = { ...first, heading_deg: (lane.heading * 180) / Math.PI };
  const drawn = rows.filter((row) => list(row.path).every((pose) => list(pose).slice(0, 2).every(is_number)));
  const begin = { path: [[first.x_m, first.y_m, first.heading_deg]] };
  const ground = common_ground(record, [begin, ...drawn], origin);
  panel.append(el("div", { class: "futures" }, rows.map((row) => {
    const marks = [row.policy === record.best ? tag("best", "good") : null, row.policy === record.decision?.policy ? tag(begun_words(record), "strong") : null];
    const words = row.refusal ? `refused: ${row.refusal}` : contact_words(row.contact);
    const shown = { ...row, path: drawn.includes(row) && list(row.path).length ? row.path : begin.path };
    const plan = draw_future(record, shown, row.refusal ? { ...first } : origin, ground);
    return el("figure", { class: `future ${row.refusal ? "refused" : ""} ${row.policy === record.decision?.policy ? "chosen" : ""}` },
      el("figcaption", {}, el("b", { text: `${row.policy} ${row.name ?? ""}` }), ...marks.filter(Boolean).flatMap((mark) => [" ", mark]),
        el("small", { class: "future-words" }, row.refusal ? words : row.contact ? el("span", { class: "hit", text: `✕ ${words}` }) : el("span", { class: "free", text: is_number(row.clearance_m) ? `✓ clear by ${num(row.clearance_m, 1, "m")}${row.nearest?.to ? `, of ${row.nearest.to}` : ""}` : "✓ no contact" }),
          row.refusal ? null : el("span", { class: "future-harm", text: `harm ${num(row.harm, 3)}` }))),
      plan.picture(`${row.name ?? row.policy}: ${words}`));
  })));
  if (panel.querySelector(".stale")) panel.append(el("p", { class: "soft stale-words", text: "Dashed: where somebody was when the record ended; how that one went on is not in it." }));
}

// --- bars -----------------------------------------------------------------------------------------

/** One bar of a chart: its share of `most`, with its interval when there is one. */
function cost_bar(value, most, low, high, kind) {
  const share = (v) => `${(100 * Math.min(1, Math.max(0, v / most))).toFixed(2)}%`;
  return el("span", { class: `cost-rail ${kind}`, "aria-hidden": "true" },
    is_number(value) ? el("span", { class: "cost-bar", style: { width: share(value) } }) : null,
    is_number(low) && is_number(high) && high > low ? el("span", { class: "whisker", style: { left: share(low), width: share(high - low) } }) : null);
}

function cost_chart(record, name, unit, key, decimals) {
  const rows = record.hindsight;
  const most = Math.max(1e-9, ...rows.flatMap((row) => [row[key], row[`${key}_hi`]]).filter(is_number));
  const interval = (row) => (is_number(row[`${key}_lo`]) && is_number(row[`${key}_hi`]) ? ` (${num(row[`${key}_lo`], decimals)} to ${num(row[`${key}_hi`], decimals)})` : "");
  return el("div", { class: "cost", role: "group", "aria-label": name }, el("h4", { text: unit ? `${name} [${unit}]` : name }), rows.map((row) => {
    const kind = row.policy === record.decision?.policy ? "chosen" : row.policy === record.best ? "best" : "";
    return el("div", { class: "cost-row" }, el("span", { class: "cost-name", text: row.name ?? String(row.policy) }),
      row.refusal ? el("span", { class: "soft", text: "refused" }) : cost_bar(row[key], most, row[`${key}_lo`], row[`${key}_hi`], kind), el("span", { class: "cost-text", text: row.refusal ? none : `${num(row[key], decimals)}${interval(row)}` }));
  }));
}

/** Harm and Collision Loss of the eight beside each other. */
function cost_charts(record) {
  return record.hindsight.some((row) => !row.refusal && (is_number(row.harm) || is_number(row.collision_loss)))
    ? el("div", { class: "costs" }, cost_chart(record, "Harm", "", "harm", 3), cost_chart(record, "Collision Loss", "m/s", "collision_loss", 2)) : null;
}
