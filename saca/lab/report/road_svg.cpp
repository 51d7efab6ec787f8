#include "saca/lab/report/road_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace saca::report {
namespace {

using world::Beyond;

constexpr double station_step = 2.0;  // of drawn arcs [m]

/// Stations of the lane that the picture can show.
struct Stations {
  double from;
  double to;
};

/// Draws along the lane of one road in one picture.
class RoadPen {
 public:
  RoadPen(const world::Road& road, const PictureFrame& frame)
      : road_(road), frame_(frame), stations_(stations_in(road, frame)) {}

  [[nodiscard]] std::string strip(std::string_view classes, double d_low, double d_high) const {
    std::vector<Vec2> outline = line_at(d_low);
    std::vector<Vec2> other = line_at(d_high);
    outline.insert(outline.end(), other.rbegin(), other.rend());
    return svg_polygon(classes, outline);
  }

  [[nodiscard]] std::string line(std::string_view classes, double d) const {
    return svg_polyline(classes, line_at(d));
  }

  /// Calls `draw` with pixel, at stations that are multiples of `step`.
  template <class Draw>
  void every(double step, double d, const Draw& draw) const {
    for (double k = std::ceil(stations_.from / step); k * step <= stations_.to; ++k) {
      const Vec2 at = px(k * step, d);
      const SvgSize size = frame_.size();
      constexpr double outside = 20.0;
      if (at.x > -outside && at.x < size.width + outside && at.y > -outside &&
          at.y < size.height + outside) {
        draw(at, k);
      }
    }
  }

  [[nodiscard]] double scale() const { return frame_.scale; }

 private:
  static Stations stations_in(const world::Road& road, const PictureFrame& frame) {
    const Pose X_WP = inverse(frame.X_PW);
    const double middle = world::to_lane(road, X_WP).s;
    const Extent& seen = frame.seen_P;
    double reach = 1.2 * std::max({-seen.low.x, seen.high.x, -seen.low.y, seen.high.y}) + 10.0;
    if (road.curvature != 0.0) {
      reach = std::min(1.5 * reach, 2.8 / std::abs(road.curvature));  // not round the whole circle
    }
    return {middle - reach, middle + reach};
  }

  [[nodiscard]] Vec2 px(double s, double d) const {
    // Lines on the inner side of a bend end before its centre.
    const double inner = 0.98 / std::max(std::abs(road_.curvature), 1e-9);
    return frame_.px(world::from_lane(road_, {s, std::clamp(d, -inner, inner), 0.0}).p);
  }

  [[nodiscard]] std::vector<Vec2> line_at(double d) const {
    const double length = stations_.to - stations_.from;
    const int steps =
        road_.curvature == 0.0 ? 1 : static_cast<int>(std::ceil(length / station_step));
    std::vector<Vec2> points;
    for (int k = 0; k <= steps; ++k) {
      points.push_back(px(stations_.from + length * k / steps, d));
    }
    return points;
  }

  const world::Road& road_;
  const PictureFrame& frame_;
  Stations stations_;
};

/// Full lanes beyond the ego's own, towards an edge `room` from its centre.
int lanes_beside(const world::Road& road, double room) {
  const double lanes = std::floor((room - road.lane_width / 2.0) / road.lane_width + 0.15);
  return static_cast<int>(std::clamp(lanes, 0.0, 5.0));
}

std::string markings(const RoadPen& pen, const world::Road& road) {
  const int left = lanes_beside(road, road.left_edge);
  const int right = lanes_beside(road, -road.right_edge);
  std::string out;
  for (int n = -right; n <= left + 1; ++n) {
    const double d = (n - 0.5) * road.lane_width;
    const bool outer = n == -right || n == left + 1;
    const bool oncoming = (n == 1 && road.oncoming_left) || (n == 0 && road.oncoming_right);
    constexpr double inside = 0.15;  // of the edge [m]
    if (outer) {
      const bool crossing = road.topology == world::Topology::intersection;
      const double at = std::clamp(d, road.right_edge + inside, road.left_edge - inside);
      out += pen.line(crossing ? "mark dashed" : "mark", at);
    } else if (oncoming) {
      constexpr double half_gap = 0.2;
      out += pen.line("mark", d - half_gap) + pen.line("mark", d + half_gap);
    } else {
      out += pen.line("mark dashed", d);
    }
  }
  return out;
}

std::string barrier(const RoadPen& pen, double d) {
  std::string out = pen.line("barrier", d);
  pen.every(4.0, d, [&](Vec2 at, double) {
    constexpr double half = 2.6;
    out += svg_rect("post", at - Vec2{half, half}, {2.0 * half, 2.0 * half});
  });
  return out;
}

/// A sign that trees stand there, not a survey: any fixed mixing of the station will do.
std::string trees(const RoadPen& pen, double edge, double outwards) {
  std::string out;
  for (const double row : {2.2, 5.6}) {
    pen.every(row < 3.0 ? 5.0 : 7.0, edge + outwards * row, [&](Vec2 at, double k) {
      const double whim = std::abs(std::sin(12.9898 * k + row));
      out += svg_circle("tree", at, (1.1 + 0.8 * whim) * pen.scale());
      out += svg_circle("trunk", at, 0.25 * pen.scale());
    });
  }
  return out;
}

std::string what_is_beyond(const RoadPen& pen, Beyond beyond, double edge, double outwards) {
  switch (beyond) {
    case Beyond::kerb: {
      const double far = edge + outwards * 0.5;
      return pen.strip("kerb", edge, far) + pen.strip("kerb-hatch", edge, far);
    }
    case Beyond::barrier:
      return pen.line("edge", edge) + barrier(pen, edge + outwards * 0.3);
    case Beyond::trees:
      return pen.line("edge", edge) + trees(pen, edge, outwards);
    case Beyond::unmarked:
      break;
  }
  return pen.line("edge", edge);
}

}  // namespace

std::string road_svg(const world::Road& road, const PictureFrame& frame) {
  const RoadPen pen(road, frame);
  // Of an intersection only the ego's road is known: the ground beside it is paved, too.
  const bool crossing = road.topology == world::Topology::intersection;
  return svg_rect(crossing ? "paved" : "ground", {0.0, 0.0}, frame.size()) +
         pen.strip("road", road.right_edge, road.left_edge) + markings(pen, road) +
         what_is_beyond(pen, road.left_beyond, road.left_edge, 1.0) +
         what_is_beyond(pen, road.right_beyond, road.right_edge, -1.0);
}

}  // namespace saca::report
