// The lane's centre line: an arc. Missing numbers of the road mean a straight lane along x.

/** Lane frame to world: s along the centre line, d to the left of it. */
function from_lane(road, s, d) {
  const k = road.curvature_1pm || 0, start = radians(road.heading_deg || 0);
  const along = Math.abs(k) < 1e-9 ? s : Math.sin(k * s) / k;
  const across = Math.abs(k) < 1e-9 ? 0 : (1 - Math.cos(k * s)) / k;
  const x = along - d * Math.sin(k * s), y = across + d * Math.cos(k * s);
  return {
    x: (road.x_m || 0) + x * Math.cos(start) - y * Math.sin(start),
    y: (road.y_m || 0) + x * Math.sin(start) + y * Math.cos(start), heading: start + k * s };
}

/** World to lane frame; unique within the arc's radius. */
function to_lane(road, p) {
  const k = road.curvature_1pm || 0, start = radians(road.heading_deg || 0);
  const dx = p.x - (road.x_m || 0), dy = p.y - (road.y_m || 0);
  const x = dx * Math.cos(start) + dy * Math.sin(start), y = -dx * Math.sin(start) + dy * Math.cos(start);
  if (Math.abs(k) < 1e-9) return { s: x, d: y };
  const turned = Math.atan2(k * x, 1 - k * y);
  return { s: turned / k, d: (1 - Math.hypot(k * x, 1 - k * y)) / k };
}
