// The record (docs/formats.md) with its gaps filled by null and empty lists, and read at any time.

const intention_words = {
  M: "goes on", LC: "changes to the left", RC: "changes to the right", FB: "brakes", LB: "brakes and moves left",
  RB: "brakes and moves right", stop: "stops", cross: "crosses the lane" };

const event_words = {
  preview: "T2 preview", risk: "risk", intention: "intention", forecast: "forecast", memory: "memory", ask: "ask model",
  first_answer: "first answer", answer: "answer", check: "check", cached: "plan cached", trigger: "T1 trigger",
  match: "match", execute: "execute", switch: "switch", contact: "contact", rest: "rest", fault: "fault" };

/** Beliefs over time with their thousandths as shares; rows that do not fit the times and names are left out. */
function read_intentions(raw) {
  const row = (text) => String(text ?? "").split(" ").map((n) => Number(n) / 1000);
  return list(raw).map(dict).map((one) => {
    const of = list(one.of), whole = (r) => r.length === of.length && r.every((p) => is_number(p) && p >= 0);
    const rows = list(one.times_s).map((t, k) => ({ t, now: row(list(one.now_permille)[k]), soon: row(list(one.soon_permille)[k]) }))
      .filter(({ t, now, soon }) => is_number(t) && whole(now) && whole(soon));
    return { actor: String(one.actor), of, times: rows.map((r) => r.t), now: rows.map((r) => r.now), soon: rows.map((r) => r.soon) };
  }).filter((one) => one.times.length);
}

/** Event of a kind; the first, or null. */
const first_event = (record, kind) => record.events.find((e) => e.kind === kind) ?? null;

function read_record(text) {
  const raw = dict(JSON.parse(text));
  const frames = list(raw.frames).map(dict).filter((f) => is_number(f.t_s) && f.ego && is_number(f.ego.x_m) && is_number(f.ego.y_m));
  const events = list(raw.events).map(dict).filter((e) => is_number(e.t_s)).sort((a, b) => a.t_s - b.t_s);
  const record = {
    ...raw, frames, events, scenario: dict(raw.scenario), road: dict(raw.road), ego: dict(raw.ego),
    actors: list(raw.actors).map(dict), previews: list(raw.previews).map(dict), decision: raw.decision ?? null, switches: list(raw.switches).map(dict).filter((one) => is_number(one.t_s)), review: raw.review ?? null, result: dict(raw.result),
    hindsight: list(raw.hindsight).map(dict), intentions: read_intentions(raw.intentions), timing: dict(raw.timing), thresholds: dict(raw.thresholds) };
  record.start = frames.length ? frames[0].t_s : 0;
  // A contact lies between frames, a late answer may come after the last one.
  record.end = Math.max(record.start, ...frames.slice(-1).map((f) => f.t_s), ...(frames.length ? events : []).map((e) => e.t_s),
    frames.length && is_number(record.result.contact?.time_s) ? record.result.contact.time_s : record.start);
  record.t2 = first_event(record, "preview")?.t_s ?? null;
  record.t1 = first_event(record, "trigger")?.t_s ?? record.decision?.time_s ?? null;
  record.verdicts = read_verdicts(raw.verdicts);
  record.hypotheses = read_hypotheses(raw.hypotheses);
  record.begun = read_begun(record);
  record.shape_of = new Map(record.actors.map((a) => [a.id, a]));
  record.risk_of = new Map();
  const told = record.previews[shown_preview(record)] ?? null;
  for (const actor of list(told?.actors)) record.risk_of.set(actor.id, actor.risk);
  return record;
}

/** Index of the preview that was matched, or else of the likeliest. */
function shown_preview({ decision, previews }) {
  if (is_number(decision?.preview)) return decision.preview;
  return previews.reduce((best, one, k) => ((one.probability ?? 0) > (previews[best].probability ?? 0) ? k : best), 0);
}

/** Id of the actor with the largest risk in the preview that counts, or null. */
function most_dangerous(record) {
  let most = null;
  for (const [id, risk] of record.risk_of) if (is_number(risk) && risk > (record.risk_of.get(most) ?? 0)) most = id;
  return most;
}

function mix(a, b, share) {
  if (!is_number(a) || !is_number(b)) return is_number(a) ? a : null;
  return a + (b - a) * share;
}

function mix_angle(a, b, share) {
  if (!is_number(a) || !is_number(b)) return is_number(a) ? a : null;
  return a + ((((b - a) % 360) + 540) % 360 - 180) * share;
}

function mix_body(a, b, share) {
  const body = { ...a };
  for (const key of Object.keys(a)) {
    if (key === "heading_deg") body[key] = mix_angle(a[key], b[key], share);
    else if (is_number(a[key])) body[key] = mix(a[key], b[key], share);
  }
  return body;
}

/** Index of the last frame at or before t. */
function frame_index(frames, t) {
  let low = 0, high = frames.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (frames[middle].t_s <= t + 1e-9) low = middle; else high = middle - 1;
  }
  return low;
}

/** The frame at t, straight between its neighbours; null without frames. */
function frame_at(record, t) {
  const { frames } = record;
  if (!frames.length) return null;
  const k = frame_index(frames, t), a = frames[k], b = frames[Math.min(k + 1, frames.length - 1)];
  const share = b.t_s > a.t_s ? Math.min(1, Math.max(0, (t - a.t_s) / (b.t_s - a.t_s))) : 0;
  const next = new Map(list(b.actors).map((actor) => [actor.id, actor]));
  return {
    ...a, t_s: t, ego: mix_body(a.ego, b.ego, share),
    actors: list(a.actors).map((actor) => (next.has(actor.id) ? mix_body(actor, next.get(actor.id), share) : actor)),
    conflict_s: is_number(a.conflict_s) && is_number(b.conflict_s) ? mix(a.conflict_s, b.conflict_s, share) : a.conflict_s };
}

/** "car1 · front · 7.2 m/s" */
function contact_words(contact) {
  if (!contact) return "none";
  const face = contact.ego_face ? `${contact.ego_face} of the ego` : null;
  return [contact.with, face, is_number(contact.relative_speed_mps) ? num(contact.relative_speed_mps, 1, "m/s") : null]
    .filter(Boolean).join(" · ");
}
