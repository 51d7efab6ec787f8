// The road under the plan view: an arc, its lanes, its edges and what stands beyond them.

/** Where lines run: full lanes to either side of the ego's, and the edges. Lanes are as wide as the ego's. */
function lane_layout(road) {
  const width = road.lane_width_m > 0 ? road.lane_width_m : 3.5;
  const left = is_number(road.left_edge_m) ? road.left_edge_m : width / 2;
  const right = is_number(road.right_edge_m) ? road.right_edge_m : -width / 2;
  const lanes = (room) => Math.min(5, Math.max(0, Math.floor((room - width / 2) / width + 0.15)));
  return { width, left, right, lanes_left: lanes(left), lanes_right: lanes(-right) };
}

class RoadView {
  constructor(road) {
    this.road = road;
    this.layout = lane_layout(road);
    this.crossing = road.topology === "intersection";
  }

  /** Draws between two stations in metres; the context's unit is the metre, in W. */
  draw(g, colours, from, to) {
    const { left, right, width, lanes_left, lanes_right } = this.layout;
    this.from = Math.floor(from / 12) * 12;
    this.to = to;
    this.edge_ground(g, colours);
    this.strip(g, right, left, colours.road);
    this.beyond(g, colours, left, 1, this.road.left_beyond);
    this.beyond(g, colours, right, -1, this.road.right_beyond);
    for (let n = -lanes_right; n <= lanes_left + 1; n++) {
      const d = (n - 0.5) * width;
      const outer = n === -lanes_right || n === lanes_left + 1;
      const oncoming = (n === 1 && this.road.oncoming_left) || (n === 0 && this.road.oncoming_right);
      const edge = outer ? (n > 0 ? Math.min(d, left - 0.15) : Math.max(d, right + 0.15)) : d;
      if (oncoming && !outer) for (const side of [-0.12, 0.12]) this.line(g, edge + side, colours.mark, 0.12, []);
      else this.line(g, edge, colours.mark, 0.14, outer && !this.crossing ? [] : [4, 8]);
    }
    for (let n = -lanes_right; n <= lanes_left; n++) {
      const against = (n > 0 && this.road.oncoming_left) || (n < 0 && this.road.oncoming_right);
      this.arrows(g, n * width, against, colours.mark_soft);
    }
  }

  /** In an intersection the ground beside the road is paved, too: where the other road runs is not in the record. */
  edge_ground(g, colours) {
    if (this.crossing) this.strip(g, this.layout.right - 200, this.layout.left + 200, colours.paved);
  }

  stations(step) {
    const all = [];
    for (let s = this.from; s < this.to + step; s += step) all.push(s);
    return all;
  }

  path(g, d, backwards = false) {
    const stations = this.stations(this.road.curvature_1pm ? 2 : 600);
    for (const s of backwards ? stations.reverse() : stations) {
      const p = from_lane(this.road, s, d);
      g.lineTo(p.x, p.y);
    }
  }

  strip(g, d_low, d_high, colour) {
    g.beginPath();
    this.path(g, d_low);
    this.path(g, d_high, true);
    g.closePath();
    g.fillStyle = colour;
    g.fill();
  }

  line(g, d, colour, width, dashes) {
    g.beginPath();
    this.path(g, d);
    g.setLineDash(dashes);
    g.lineWidth = width;
    g.strokeStyle = colour;
    g.stroke();
    g.setLineDash([]);
  }

  beyond(g, colours, edge, side, what) {
    if (what === "kerb") this.strip(g, edge, edge + side * 0.35, colours.kerb);
    if (what === "barrier") this.barrier(g, colours, edge + side * 0.3);
    if (what === "trees") this.trees(g, colours, edge, side);
  }

  barrier(g, colours, d) {
    this.line(g, d, colours.barrier, 0.28, []);
    g.fillStyle = colours.barrier;
    for (const s of this.stations(4)) {
      const p = from_lane(this.road, s, d);
      g.fillRect(p.x - 0.28, p.y - 0.28, 0.56, 0.56);
    }
  }

  trees(g, colours, edge, side) {
    for (const s of this.stations(6)) {
      // Any fixed mixing of the index will do: the trees are a sign, not a survey.
      const whim = Math.abs(Math.sin(s * 12.9898 + side * 4.1)), more = Math.abs(Math.sin(s * 78.233));
      const p = from_lane(this.road, s + 3 * more, edge + side * (2.2 + 2.6 * whim));
      g.beginPath();
      g.arc(p.x, p.y, 1.2 + 0.8 * more, 0, 2 * Math.PI);
      g.fillStyle = colours.tree;
      g.fill();
    }
  }

  arrows(g, d, against, colour) {
    for (let s = Math.floor(this.from / 36) * 36; s < this.to; s += 36) {
      const p = from_lane(this.road, s, d), turn = p.heading + (against ? Math.PI : 0);
      const at = (a, b) => [p.x + a * Math.cos(turn) - b * Math.sin(turn), p.y + a * Math.sin(turn) + b * Math.cos(turn)];
      g.beginPath();
      for (const [a, b] of [[-1.6, 0.08], [0.2, 0.08], [0.2, 0.42], [1.8, 0], [0.2, -0.42], [0.2, -0.08], [-1.6, -0.08]]) g.lineTo(...at(a, b));
      g.closePath();
      g.fillStyle = colour;
      g.fill();
    }
  }
}
