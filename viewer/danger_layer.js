// The danger maps of a record (docs/formats.md), under the cars: each moves with its actor until the next one follows.

const finer = 4;                              // pixels of a picture per step of the map
const deepest = 2, roomiest = 5;              // [m]: deeper is not redder, more room is not shown
const veil = { danger: 0.62, safety: 0.42 };  // opacity; the road stays visible

const is_danger_map = (map) => ["t_s", "x_m", "y_m", "heading_deg", "first_x_m", "first_y_m", "step_m"].every((key) => is_number(map?.[key])) &&
  map.step_m > 0 && list(map.rows).length > 1 && map.rows.every((row) => typeof row === "string");

class DangerLayer {
  constructor(record) {
    const given = dict(record.danger_maps);
    this.actor = given.actor;
    this.maps = list(given.maps).filter(is_danger_map).map((map) => ({ ...map, raster: finer_raster(map) }));
    // Frames need not fall on the interval: a map waits for the next one.
    this.longest = 1.2 * (is_number(given.interval_s) ? given.interval_s : 0);
    this.shown = true;
  }

  read_colours(style) {
    const side = (name) => packed_shades(style.getPropertyValue(name).split(",").map((text) => [1, 3, 5].map((i) => parseInt(text.trim().slice(i, i + 2), 16))));
    [this.danger, this.safety] = [side("--value-danger"), side("--value-safety")];
    this.line = style.getPropertyValue("--ink").trim();
    for (const map of this.maps) map.picture = null;
  }

  /** The newest map not later than t; null before the first and after the last. */
  at(t) {
    const map = this.maps.findLast((one) => one.t_s <= t + 1e-9);
    return map && t <= map.t_s + this.longest ? map : null;
  }

  /** Where a map's frame stands now, and what is drawn of it: { map, x_m, y_m, heading }; null: nothing. */
  placed(frame, t) {
    const map = this.shown ? this.at(t) : null, body = list(frame.actors).find((actor) => actor.id === this.actor);
    if (!map || !has_pose(body)) return null;
    const h = radians(body.heading_deg || 0), c = Math.cos(h), s = Math.sin(h);
    return { map, x_m: body.x_m + map.x_m * c - map.y_m * s, y_m: body.y_m + map.x_m * s + map.y_m * c, heading: h + radians(map.heading_deg) };
  }

  /** On a canvas in metres of W. */
  draw(g, frame, t, px) {
    const placed = this.placed(frame, t);
    if (!placed) return;
    const { map } = placed, dot = map.step_m / finer, { columns, rows, lines } = map.raster;
    map.picture ??= this.picture(map.raster);
    g.save();
    g.translate(placed.x_m, placed.y_m);
    g.rotate(placed.heading);
    g.translate(map.first_x_m, map.first_y_m);
    g.drawImage(map.picture, -dot / 2, -dot / 2, columns * dot, rows * dot);
    g.beginPath();
    for (const [x0, y0, x1, y1] of lines) {
      g.moveTo((x0 - 0.5) * dot, (y0 - 0.5) * dot);
      g.lineTo((x1 - 0.5) * dot, (y1 - 0.5) * dot);
    }
    g.strokeStyle = this.line;
    g.lineWidth = 1.2 * px;
    g.stroke();
    g.restore();
  }

  /** V of a place in W [m]; null where nothing is drawn. */
  value(frame, t, p) {
    const placed = this.placed(frame, t);
    if (!placed) return null;
    const { map } = placed, c = Math.cos(placed.heading), s = Math.sin(placed.heading), x = p.x_m - placed.x_m, y = p.y_m - placed.y_m;
    const column = Math.round((finer * (x * c + y * s - map.first_x_m)) / map.step_m), row = Math.round((finer * (-x * s + y * c - map.first_y_m)) / map.step_m);
    if (column < 0 || row < 0 || column >= map.raster.columns || row >= map.raster.rows) return null;
    const value = map.raster.values[row * map.raster.columns + column];
    return Number.isNaN(value) ? null : value;
  }

  /** Packed as a pixel; clear where nothing is known or there is room to spare. */
  colour(value) {
    if (Number.isNaN(value) || value < -roomiest) return 0;
    const share = value >= 0 ? Math.min(1, value / deepest) : 1 + value / roomiest;
    const shade = value >= 0 ? this.danger[Math.round(shades * (0.5 + 0.3 * share))] : this.safety[Math.round(0.6 * shades)];
    return ((shade & 0xffffff) | (Math.round(255 * (value >= 0 ? veil.danger : veil.safety * share)) << 24)) >>> 0;
  }

  picture({ values, columns, rows }) {
    const canvas = el("canvas", { width: columns, height: rows }), g = canvas.getContext("2d");
    const image = g.createImageData(columns, rows), pixels = new Uint32Array(image.data.buffer);
    for (let i = 0; i < pixels.length; i++) pixels[i] = this.colour(values[i]);
    g.putImageData(image, 0, 0);
    return canvas;
  }
}

/** A map's values [m] straight between its points, the lowest y first; NaN where a corner is not known. */
function finer_raster(map) {
  const points = map.rows.map((row) => row.split(" ").map((text) => (text === "." ? NaN : Number(text) / 10)));
  const columns = (points[0].length - 1) * finer + 1, rows = (points.length - 1) * finer + 1, values = new Float32Array(columns * rows);
  for (let r = 0; r < rows; r++) {
    const low = points[Math.floor(r / finer)], high = points[Math.ceil(r / finer)], up = (r % finer) / finer;
    for (let c = 0; c < columns; c++) {
      const left = Math.floor(c / finer), right = Math.ceil(c / finer), share = (c % finer) / finer;
      values[r * columns + c] = (1 - up) * between_two(low[left], low[right], share) + up * between_two(high[left], high[right], share);
    }
  }
  return { values, columns, rows, lines: zero_pieces(values, columns, rows, 1).filter((piece) => piece.every(Number.isFinite)) };
}

const between_two = (a, b, share) => a + share * (b - a);
