// The first contact from near: both bodies, the faces that met, the normal and the velocity of the other against the ego.

const face_parts = { front: [[1, 1], [1, -1]], rear: [[-1, 1], [-1, -1]], left: [[1, 1], [-1, 1]], right: [[1, -1], [-1, -1]] };
const px_per_mps = 5;  // of the arrow

/** The close-up of the result's contact; null where the record does not say where it was. */
function close_up(record) {
  const contact = record.result.contact, frame = contact && is_number(contact.time_s) ? frame_at(record, contact.time_s) : null;
  if (!has_pose(frame?.ego) || !is_number(contact.x_m) || !is_number(contact.y_m)) return null;
  const ego = frame.ego, other = list(frame.actors).find((actor) => actor.id === contact.with && has_pose(actor)), place = { x: contact.x_m, y: contact.y_m };
  const origin = { x_m: contact.x_m, y_m: contact.y_m, heading_deg: ego.heading_deg || 0 };
  const plan = new PlanSvg(record.road, origin, { low: { x: -6, y: -3.6 }, high: { x: 6, y: 3.6 } }, 420, 252);
  const shape = record.shape_of.get(contact.with) ?? { shape: "ellipse", length_m: 1, width_m: 1 };
  plan.draw_road();
  if (other) plan.body("body threat", other, shape);
  if (other) plan.windscreen(other, shape);
  plan.body("body ego", ego, record.ego);
  plan.windscreen(ego, record.ego);
  struck_face(plan, ego, record.ego, contact.ego_face);
  if (other) struck_face(plan, other, shape, contact.other_face);
  for (const [name, pose] of [["ego", ego], ...(other ? [[contact.with, other]] : [])]) {
    const p = plan.px({ x: pose.x_m, y: pose.y_m }), half = 3.4 * name.length + 6;
    plan.label(name, Math.min(Math.max(p.x, half), plan.width - half), Math.min(Math.max(p.y + 24, 16), plan.height - 24));
  }
  plan.star(contact.x_m, contact.y_m, 8);
  if (is_number(contact.normal_deg)) arrow_with_name(plan, "normal", place, contact.normal_deg, 66, "normal", -9);
  if (is_number(contact.v_rel_x_mps) && is_number(contact.v_rel_y_mps)) {
    const direction = (Math.atan2(contact.v_rel_y_mps, contact.v_rel_x_mps) * 180) / Math.PI;
    const way = Math.min(120, Math.max(26, px_per_mps * Math.hypot(contact.v_rel_x_mps, contact.v_rel_y_mps)));
    arrow_with_name(plan, "v-rel", place, direction, way, `relative velocity ${num(contact.relative_speed_mps, 1, "m/s")}`, -22);
  }
  plan.scale_bar();
  return el("figure", { class: "close-up" }, plan.picture(`Contact with ${contact.with} from near`), el("figcaption", { class: "soft",
    text: `The contact from near, the ego heading to the right; the faces that met are drawn bold. ${change_words(contact)}` }));
}

/** What the impact did to both. */
function change_words(contact) {
  const known = [["ego", contact.ego_delta_v_mps], [contact.with, contact.other_delta_v_mps]].filter(([name, v]) => name !== "edge" && is_number(v));
  return known.length ? `Change of velocity: ${known.map(([name, v]) => `${name} ${num(v, 1, "m/s")}`).join(", ")}.` : "";
}

function struck_face(plan, pose, shape, face) {
  if (shape.shape !== "ellipse" && face_parts[face]) plan.polyline("face", body_points(pose, shape, face_parts[face]));
}

/** The name stands under an arrow that points down, else `rise` px from its tip; inside the picture. */
function arrow_with_name(plan, kind, p, direction_deg, way, name, rise) {
  const tip = plan.arrow(kind, p, direction_deg, way), below = tip.y > plan.px(p).y + 10, half = 3.4 * name.length;
  plan.label(name, Math.min(Math.max(tip.x, half + 4), plan.width - half - 4), Math.min(Math.max(tip.y + (below ? 17 : rise), 14), plan.height - 24));
}
