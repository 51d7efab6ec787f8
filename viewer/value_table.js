// The values of a record (docs/formats.md, saca.value_page/1): decoded, and read over the plane that is shown: of the first two
// axes, or of x and y in the obstacle's frame where they are kept as the ego sees them.

/** A byte as its value: the square root is what was rounded, finest about 0, and no sign is lost. */
function decoded_values(extent) {
  return Float32Array.from({ length: 256 }, (_, byte) => {
    const root = (byte - 128) / 127;
    return root >= 0 ? extent.highest * root * root : extent.lowest * root * root;
  });
}

function bytes_of(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

class ValueTable {
  constructor(record) {
    this.axes = record.axes;
    this.seen_from_ego = record.shown !== null;
    this.bytes = bytes_of(record.values);
    this.meaning = decoded_values(record.extent);
    this.strides = [];
    let stride = 1;
    for (const axis of this.axes) {
      this.strides.push(stride);
      stride *= axis.coordinates.length;
    }
    this.cells = stride;
    this.lines = [0, 1].map((d) => this.line_of(d));
  }

  /** Points along an axis of the plane, mirrored ones and that beyond the seam too: {at, point, flipped}. */
  line_of(d) {
    const axis = this.axes[d], points = axis.coordinates.map((at, point) => ({ at, point, flipped: false }));
    if (axis.edge === "periodic") return [...points, { at: axis.last, point: 0, flipped: false }];
    if (axis.edge !== "mirrored" || (is_number(axis.turned) && axis.turned < 2)) return points;
    return [...points.slice(1).reverse().map((p) => ({ at: -p.at, point: p.point, flipped: true })), ...points];
  }

  /** Points to both sides of a coordinate, and the share of the second. */
  between(d, coordinate) {
    const axis = this.axes[d], at = axis.coordinates, n = at.length;
    if (axis.edge === "periodic") {
      const period = axis.last - at[0], x = at[0] + (((coordinate - at[0]) % period) + period) % period;
      if (x >= at[n - 1]) return [n - 1, 0, Math.min(1, (x - at[n - 1]) / (axis.last - at[n - 1]))];
      coordinate = x;
    }
    let low = 0, high = n - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (at[middle] <= coordinate) low = middle; else high = middle;
    }
    return [low, high, Math.min(1, Math.max(0, (coordinate - at[low]) / (at[high] - at[low])))];
  }

  /** Corners of the further coordinates: [place, weight]. */
  corners(time, others) {
    let corners = [[time * this.cells, 1]];
    for (let d = 2; d < this.axes.length; d++) {
      const [low, high, share] = this.between(d, others[d]);
      corners = corners.flatMap(([at, weight]) => [[at + low * this.strides[d], weight * (1 - share)], [at + high * this.strides[d], weight * share]]);
    }
    return corners.filter(([, weight]) => weight > 0);
  }

  /** Values at the crossings of both lines; x runs first. */
  plane(time, others) {
    const [columns, rows] = this.lines, out = new Float32Array(columns.length * rows.length), known = new Map();
    rows.forEach((row, r) => columns.forEach((column, c) => {
      const key = (row.flipped ? 2 : 0) + (column.flipped ? 1 : 0);
      if (!known.has(key)) known.set(key, this.corners(time, this.turned(others, column.flipped, row.flipped)));
      let value = 0;
      for (const [at, weight] of known.get(key)) value += weight * this.meaning[this.bytes[at + column.point + row.point * this.strides[1]]];
      out[r * columns.length + c] = value;
    }));
    return out;
  }

  /** Ends of both coordinates of the plane that is shown. */
  whole(others) {
    const [along, across] = this.lines.map((line) => [line[0].at, line[line.length - 1].at]);
    if (!this.seen_from_ego) return [along, across];
    const c = Math.cos(others[2]), s = Math.sin(others[2]), corners = along.flatMap((ahead) => across.map((left) => [s * left - c * ahead, -s * ahead - c * left]));
    return [0, 1].map((d) => [Math.min(...corners.map((at) => at[d])), Math.max(...corners.map((at) => at[d]))]);
  }

  /** Values at the middles of columns x rows pixels over `range`, the highest y first; NaN: not kept. */
  raster(time, others, range, columns, rows) {
    if (!this.seen_from_ego) return raster_of(this, this.plane(time, others), range, columns, rows);
    return turned_raster_of(this, this.plane(time, [0, 0, -others[2], others[3]]), others[2], range, columns, rows);
  }

  turned(others, ...flipped) {
    const state = [...others];
    flipped.forEach((is, d) => { if (is && is_number(this.axes[d].turned)) state[this.axes[d].turned] *= -1; });
    return state;
  }
}

/** Where `count` middles between two ends lie among rising points: the lower point and the share of the next. */
function among(points, low, high, count) {
  const at = new Int32Array(count), share = new Float32Array(count);
  for (let i = 0, p = 0; i < count; i++) {
    const x = low + ((i + 0.5) * (high - low)) / count;
    while (p + 2 < points.length && points[p + 1].at <= x) p++;
    at[i] = p;
    share[i] = (x - points[p].at) / (points[p + 1].at - points[p].at);
  }
  return { at, share };
}

/** Between four values of a plane: `i`, the next, and both of the next row. */
function mixed(plane, i, wide, share, up) {
  const low = plane[i] + share * (plane[i + 1] - plane[i]), high = plane[i + wide] + share * (plane[i + wide + 1] - plane[i + wide]);
  return low + up * (high - low);
}

/** A plane's values at the middles of columns x rows pixels over `range`, the highest y first. */
function raster_of(table, plane, range, columns, rows) {
  const [xs, ys] = table.lines, wide = xs.length;
  const x = among(xs, ...range[0], columns), y = among(ys, ...range[1], rows);
  const out = new Float32Array(columns * rows);
  for (let r = 0; r < rows; r++) {
    const from = y.at[rows - 1 - r] * wide, up = y.share[rows - 1 - r];
    for (let c = 0; c < columns; c++) {
      out[r * columns + c] = mixed(plane, from + x.at[c], wide, x.share[c], up);
    }
  }
  return out;
}

/** The point below a coordinate, looked for from `p` on: pixels follow one another closely. */
function point_below(at, p, coordinate) {
  while (p > 0 && at[p] > coordinate) p--;
  while (p + 2 < at.length && at[p + 1] <= coordinate) p++;
  return p;
}

/** Likewise of a plane of ahead and left, over x and y of the ego in the obstacle's frame; NaN beyond the plane. */
function turned_raster_of(table, plane, course, range, columns, rows) {
  const [aheads, lefts] = table.lines.map((line) => Float64Array.from(line, (p) => p.at)), wide = aheads.length;
  const [[x0, x1], [y0, y1]] = range, cos = Math.cos(course), sin = Math.sin(course);
  const out = new Float32Array(columns * rows).fill(NaN);
  let i = 0, j = 0;
  for (let r = 0, n = 0; r < rows; r++) {
    const y = y1 - ((r + 0.5) * (y1 - y0)) / rows;
    for (let c = 0; c < columns; c++, n++) {
      const x = x0 + ((c + 0.5) * (x1 - x0)) / columns, ahead = -(cos * x + sin * y), left = sin * x - cos * y;
      if (!(ahead >= aheads[0] && ahead <= aheads[wide - 1] && left >= lefts[0] && left <= lefts[lefts.length - 1])) continue;
      i = point_below(aheads, i, ahead);
      j = point_below(lefts, j, left);
      out[n] = mixed(plane, j * wide + i, wide, (ahead - aheads[i]) / (aheads[i + 1] - aheads[i]), (left - lefts[j]) / (lefts[j + 1] - lefts[j]));
    }
  }
  return out;
}
