// The map: values as colours, the zero level, the obstacle, axes and the bar of colours.

const plot_room = { left: 66, right: 118, top: 12, bottom: 48 };
const not_kept = 0xffe6e2de;  // grey, packed: no value has it
const plot_height = { least: 240, most: 640 };

/** Round numbers between two ends, at most `count` or so. */
function ticks_between(low, high, count) {
  const raw = (high - low) / count, decade = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * decade).find((s) => s >= raw);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
  return ticks;
}

/** The least of 1, 2, 5, 10, ... times a power of ten that is not below a value. */
function rounded_up(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((k) => k * decade).find((round) => round >= value * (1 - 1e-6));
}

const plain = (value) => String(Number(value.toPrecision(6))).replace("-", "\u2212");

class ValuePlot {
  constructor(canvas, record, table) {
    Object.assign(this, { canvas, record, table });
    this.danger = packed_shades(record.colours.danger);
    this.safety = packed_shades(record.colours.safety);
    this.axes = record.shown ?? record.axes;
    this.zoom(record.start.zoom);
  }

  /** Looks closer, about the origin where the plane has it; safe colours then end nearer to 0. */
  zoom(factor) {
    this.factor = factor;
    this.lowest = -rounded_up(-this.record.scale.lowest / factor);
  }

  layout(width, others) {
    this.range = this.table.whole(others).map(([low, high]) => {
      const middle = low < 0 && high > 0 ? 0 : (low + high) / 2;
      return [middle + (low - middle) / this.factor, middle + (high - middle) / this.factor];
    });
    const [x, y] = this.range, same = this.axes[0].unit === this.axes[1].unit;
    let wide = Math.max(200, width - plot_room.left - plot_room.right);
    let high = same ? (wide * (y[1] - y[0])) / (x[1] - x[0]) : 0.62 * wide;
    if (same && high > plot_height.most) wide *= plot_height.most / high;
    high = Math.min(plot_height.most, Math.max(plot_height.least, high));
    this.wide = Math.round(wide);
    this.high = Math.round(high);
    this.dense = Math.min(2, window.devicePixelRatio || 1);
    const all = [this.wide + plot_room.left + plot_room.right, this.high + plot_room.top + plot_room.bottom];
    [this.canvas.width, this.canvas.height] = all.map((n) => Math.round(n * this.dense));
    [this.canvas.style.width, this.canvas.style.height] = all.map((n) => `${n}px`);
  }

  /** @return  the unsafe share of what is kept of the plane */
  show(time, others, course) {
    const columns = Math.round(this.wide * this.dense), rows = Math.round(this.high * this.dense);
    this.raster = this.table.raster(time, others, this.range, columns, rows);
    [this.columns, this.rows] = [columns, rows];
    const pen = this.canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const left = Math.round(plot_room.left * this.dense), top = Math.round(plot_room.top * this.dense);
    pen.putImageData(this.coloured(), left, top);
    pen.save();
    pen.beginPath();
    pen.rect(left, top, columns, rows);
    pen.clip();
    pen.translate(left, top);
    this.draw_zero(pen);
    this.draw_outline(pen);
    if (is_number(course)) this.draw_arrow(pen, course);
    pen.restore();
    pen.setTransform(this.dense, 0, 0, this.dense, 0, 0);
    this.draw_axes(pen);
    this.draw_bar(pen);
    const kept = this.raster.reduce((n, v) => n + (Number.isNaN(v) ? 0 : 1), 0);
    return this.raster.reduce((n, v) => n + (v >= 0 ? 1 : 0), 0) / Math.max(1, kept);
  }

  shade(value) {
    const lowest = this.lowest, { highest } = this.record.scale;
    return value >= 0 ? this.danger[Math.min(shades, Math.round((shades * value) / highest))]
      : this.safety[Math.min(shades, Math.round((shades * value) / lowest))];
  }

  coloured() {
    const image = new ImageData(this.columns, this.rows), pixels = new Uint32Array(image.data.buffer);
    for (let i = 0; i < pixels.length; i++) pixels[i] = Number.isNaN(this.raster[i]) ? not_kept : this.shade(this.raster[i]);
    return image;
  }

  draw_zero(pen) {
    pen.beginPath();
    for (const piece of zero_pieces(this.raster, this.columns, this.rows, 2)) {
      if (!piece.every(Number.isFinite)) continue;
      const [x0, y0, x1, y1] = piece;
      pen.moveTo(x0, y0);
      pen.lineTo(x1, y1);
    }
    pen.strokeStyle = "#17202a";
    pen.lineWidth = 2 * this.dense;
    pen.lineCap = "round";
    pen.stroke();
  }

  draw_outline(pen) {
    if (this.record.outline.length < 3) return;
    const [x, y] = this.range;
    pen.beginPath();
    for (const [at, up] of this.record.outline) {
      pen.lineTo((this.columns * (at - x[0])) / (x[1] - x[0]), (this.rows * (y[1] - up)) / (y[1] - y[0]));
    }
    pen.closePath();
    this.twice(pen, "#e60000", 2.5);
  }

  draw_arrow(pen, course) {
    const d = this.dense, way = [Math.cos(course), -Math.sin(course)], tip = [38 * d + 20 * d * way[0], 38 * d + 20 * d * way[1]];
    pen.beginPath();
    pen.moveTo(38 * d - 20 * d * way[0], 38 * d - 20 * d * way[1]);
    pen.lineTo(...tip);
    for (const side of [0.5, -0.5]) {
      pen.moveTo(...tip);
      pen.lineTo(tip[0] - 9 * d * Math.cos(course + side), tip[1] + 9 * d * Math.sin(course + side));
    }
    this.twice(pen, "#17202a", 2.5);
  }

  /** White and wide first, to stand out from any colour. */
  twice(pen, colour, width) {
    pen.lineJoin = "round";
    for (const [style, more] of [["#ffffff", 2.5], [colour, 0]]) {
      pen.strokeStyle = style;
      pen.lineWidth = (width + more) * this.dense;
      pen.stroke();
    }
  }

  ink(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  draw_axes(pen) {
    const { left, top } = plot_room, bottom = top + this.high, [ax, ay] = this.axes;
    const [x, y] = this.range.map(([low, high], d) => [low * this.axes[d].factor, high * this.axes[d].factor]);
    pen.strokeStyle = this.ink("--soft");
    pen.fillStyle = this.ink("--ink");
    pen.lineWidth = 1;
    pen.strokeRect(left - 0.5, top - 0.5, this.wide + 1, this.high + 1);
    pen.font = "12px system-ui, \"Liberation Sans\", sans-serif";
    pen.textAlign = "center";
    for (const value of ticks_between(x[0], x[1], 9)) {
      const at = left + (this.wide * (value - x[0])) / (x[1] - x[0]);
      this.tick(pen, at, bottom, at, bottom + 5);
      pen.fillText(plain(value), at, bottom + 19);
    }
    pen.textAlign = "right";
    for (const value of ticks_between(y[0], y[1], 8)) {
      const at = bottom - (this.high * (value - y[0])) / (y[1] - y[0]);
      this.tick(pen, left - 5, at, left, at);
      pen.fillText(plain(value), left - 9, at + 4);
    }
    pen.font = "600 13px system-ui, \"Liberation Sans\", sans-serif";
    pen.textAlign = "center";
    pen.fillText(axis_name(ax), left + this.wide / 2, bottom + 40);
    this.upright(pen, axis_name(ay), left - 46, top + this.high / 2, -1);
  }

  tick(pen, x0, y0, x1, y1) {
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
    pen.stroke();
  }

  upright(pen, words, x, y, turn) {
    pen.save();
    pen.translate(x, y);
    pen.rotate((turn * Math.PI) / 2);
    pen.fillText(words, 0, 0);
    pen.restore();
  }

  /** Each side of 0 takes half of the bar. */
  draw_bar(pen) {
    const lowest = this.lowest, { highest } = this.record.scale, x = plot_room.left + this.wide + 24, half = this.high / 2;
    for (let i = 0; i < this.high; i++) {
      const up = 1 - (i + 0.5) / half, value = up >= 0 ? up * highest : -up * lowest, packed = this.shade(value);
      pen.fillStyle = `rgb(${packed & 255} ${(packed >> 8) & 255} ${(packed >> 16) & 255})`;
      pen.fillRect(x, plot_room.top + i, 18, 1.5);
    }
    pen.fillStyle = this.ink("--ink");
    pen.font = "12px system-ui, \"Liberation Sans\", sans-serif";
    pen.textAlign = "left";
    for (let quarter = -4; quarter <= 4; quarter++) {
      const share = quarter / 4, y = plot_room.top + half * (1 - share);
      this.tick(pen, x + 18, y, x + 22, y);
      pen.fillText(plain(share >= 0 ? share * highest : -share * lowest), x + 26, y + 4);
    }
    pen.fillRect(x, plot_room.top + half - 1, 18, 2);
    pen.font = "600 13px system-ui, \"Liberation Sans\", sans-serif";
    pen.textAlign = "center";
    this.upright(pen, this.record.value_words, x + 74, plot_room.top + half, 1);
  }

  /** Coordinates and value under a point of the window; null beside the plot. */
  reading(event) {
    const box = this.canvas.getBoundingClientRect(), shrunk = box.width / (this.canvas.width / this.dense);
    const across = ((event.clientX - box.left) / shrunk - plot_room.left) / this.wide, down = ((event.clientY - box.top) / shrunk - plot_room.top) / this.high;
    if (!(across >= 0 && across < 1 && down >= 0 && down < 1) || !this.raster) return null;
    const [x, y] = this.range;
    return { x: x[0] + across * (x[1] - x[0]), y: y[1] - down * (y[1] - y[0]),
      value: this.raster[Math.floor(down * this.rows) * this.columns + Math.floor(across * this.columns)] };
  }
}

const axis_name = (axis) => (axis.unit ? `${axis.name} [${axis.unit}]` : axis.name);
