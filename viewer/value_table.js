// The values of a record (docs/formats.md, saca.value_page/1): decoded, and read over the plane of the first two axes.

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

/** A plane's values at the middles of columns x rows pixels over `range`, the highest y first. */
function raster_of(table, plane, range, columns, rows) {
  const [xs, ys] = table.lines, wide = xs.length;
  const x = among(xs, ...range[0], columns), y = among(ys, ...range[1], rows);
  const out = new Float32Array(columns * rows);
  for (let r = 0; r < rows; r++) {
    const from = y.at[rows - 1 - r] * wide, up = y.share[rows - 1 - r];
    for (let c = 0; c < columns; c++) {
      const i = from + x.at[c], s = x.share[c];
      const low = plane[i] + s * (plane[i + 1] - plane[i]), high = plane[i + wide] + s * (plane[i + wide + 1] - plane[i + wide]);
      out[r * columns + c] = low + up * (high - low);
    }
  }
  return out;
}
