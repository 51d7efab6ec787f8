// The record of one manoeuvre (docs/formats.md, saca.drive/1) with its gaps filled by empty lists and null.

const sideslip_speed = 0.5;  // below it the direction of motion is noise [m/s]
const locked_rim = 0.1;      // a rim slower than this on a car that moves is locked [m/s]

function read_drive(text) {
  const raw = dict(JSON.parse(text));
  const record = {
    ...raw, car: dict(raw.car), policy: dict(raw.policy), road: dict(raw.road), start: dict(raw.start), end: dict(raw.end),
    time: list(raw.time_s).filter(is_number), wheels: list(raw.wheels).map(dict), draws: raw.draws ? dict(raw.draws) : null };
  for (const key of ["x_m", "y_m", "heading_deg", "v_x_mps", "v_y_mps", "yaw_rate_degps", "a_x_mps2", "a_y_mps2",
    "steering_deg", "steering_command_deg", "motor_Nm", "motor_command_Nm"]) record[key] = list(raw[key]);
  for (const wheel of record.wheels) {
    for (const key of ["angle_deg", "load_N", "F_x_N", "F_y_N", "peak_N", "slip", "speed_mps", "brake_Nm", "brake_command_Nm"]) wheel[key] = list(wheel[key]);
  }
  const v = (k) => [record.v_x_mps[k], record.v_y_mps[k]];
  record.speed = record.time.map((_, k) => (v(k).every(is_number) ? Math.hypot(...v(k)) : null));
  record.sideslip = record.time.map((_, k) => (record.speed[k] > sideslip_speed ? Math.atan2(v(k)[1], v(k)[0]) * (180 / Math.PI) : null));
  return record;
}

/** Index of the sample nearest to t; 0 without samples. */
function sample_at(record, t) {
  const { time } = record;
  let low = 0, high = Math.max(0, time.length - 1);
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((time[middle] + time[middle + 1]) / 2 < t) low = middle + 1; else high = middle;
  }
  return low;
}

/** Pose of the body at a sample, or null. */
function pose_at(track, k) {
  const pose = { x: list(track.x_m)[k], y: list(track.y_m)[k], heading: list(track.heading_deg)[k] };
  return Object.values(pose).every(is_number) ? pose : null;
}

const is_locked = (record, wheel, k) => is_number(wheel.speed_mps[k]) && Math.abs(wheel.speed_mps[k]) < locked_rim && record.speed[k] > sideslip_speed;

/** Steps of 1, 2 or 5 times a power of ten (of angles also 15, 30, 45, 90), at most `most` of them in `span`. */
function tick_step(span, most, angle = false) {
  const power = 10 ** Math.floor(Math.log10(span / most));
  const steps = angle && span / most > 10 ? [15, 30, 45, 90, 180] : [1, 2, 5, 10].map((s) => s * power);
  return steps.find((s) => span / s <= most + 1e-9) ?? steps[steps.length - 1];
}

/** Multiples of `step` within [from, to], free of rounding dust. */
function ticks(from, to, step) {
  const all = [];
  for (let n = Math.ceil(from / step - 1e-9); n * step <= to + 1e-9 * step; n++) all.push(n * step);
  return all;
}

const tick_words = (value, step) => num(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
