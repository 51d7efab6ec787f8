// Values as colours, and their zero level: of the value page and of the maps under the cars.

const shades = 512;  // of each side of 0

/** Colours of one side as packed pixels, from 0 outwards. */
function packed_shades(colours) {
  const out = new Uint32Array(shades + 1);
  for (let i = 0; i <= shades; i++) {
    const at = (i / shades) * (colours.length - 1), low = Math.min(Math.floor(at), colours.length - 2), rest = at - low;
    const [r, g, b] = [0, 1, 2].map((k) => Math.round(colours[low][k] + rest * (colours[low + 1][k] - colours[low][k])));
    out[i] = (255 << 24) | (b << 16) | (g << 8) | r;
  }
  return out;
}

/** Pieces of the line where a raster passes 0, [x0, y0, x1, y1] in pixels; squares of `step` pixels. */
function zero_pieces(raster, columns, rows, step) {
  const pieces = [];
  for (let r = 0; r + step < rows; r += step) {
    for (let c = 0; c + step < columns; c += step) {
      const at = [[c, r], [c + step, r], [c + step, r + step], [c, r + step]];
      const v = at.map(([x, y]) => raster[y * columns + x]), cut = [];
      for (let side = 0; side < 4; side++) {
        const next = (side + 1) % 4;
        if ((v[side] >= 0) !== (v[next] >= 0)) {
          const s = v[side] / (v[side] - v[next]);
          cut.push([at[side][0] + s * (at[next][0] - at[side][0]) + 0.5, at[side][1] + s * (at[next][1] - at[side][1]) + 0.5]);
        }
      }
      if (cut.length === 2) pieces.push([...cut[0], ...cut[1]]);
      if (cut.length === 4) {
        const joined = (v[0] >= 0) === (v[0] + v[1] + v[2] + v[3] >= 0) ? [[0, 1], [2, 3]] : [[3, 0], [1, 2]];
        for (const [a, b] of joined) pieces.push([...cut[a], ...cut[b]]);
      }
    }
  }
  return pieces;
}
