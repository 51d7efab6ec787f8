#include "saca/lab/report/fan_svg.h"

#include <fmt/format.h>

#include <cmath>

#include "saca/base/core/units.h"

namespace saca::report {
namespace {

constexpr double least_shown = 0.01;   // of a way's probability
constexpr double half_holds = 1.1774;  // standard deviations: the square root of 2 ln 2

std::string opacity(double probability) {
  return svg_number(0.15 + 0.75 * std::sqrt(probability));
}

/// Where it points at a time: along its way, which a body that drifts does not head.
double course_at(const world::Track& track, double time) {
  const Vec2 way = velocity_at(track, time - 1e-3);
  return norm(way) > 1e-3 ? std::atan2(way.y, way.x) : pose_at(track, time).yaw;
}

std::string ellipse(const LikelyWay& way, double time, const PictureFrame& frame) {
  const Vec2 middle = frame.px(pose_at(way.track, time).p);
  const world::Spread spread = spread_at(way.spread, time);
  return fmt::format(
      "<ellipse class=\"fan-place\" cx=\"{0}\" cy=\"{1}\" rx=\"{2}\" ry=\"{3}\" "
      "transform=\"rotate({4} {0} {1})\" opacity=\"{5}\"/>\n",
      svg_number(middle.x), svg_number(middle.y),
      svg_number(frame.scale * half_holds * spread.along_sd),
      svg_number(frame.scale * half_holds * spread.across_sd),
      svg_number(-to_degrees(wrap_angle(course_at(way.track, time) + frame.X_PW.yaw))),
      opacity(way.probability));
}

}  // namespace

std::string fan_svg(std::span<const LikelyWay> ways, const PictureFrame& frame) {
  std::string out;
  for (const LikelyWay& way : ways) {
    if (way.probability < least_shown) {
      continue;
    }
    std::vector<Vec2> points;
    for (const Pose& X_WA : way.track.X_WA) {
      points.push_back(frame.px(X_WA.p));
    }
    out += svg_polyline(
        "fan", points,
        fmt::format("stroke-width=\"{}\" opacity=\"{}\"", svg_number(0.8 + 5.0 * way.probability),
                    opacity(way.probability)));
    for (int second = 1; way.track.start + second <= end_time(way.track) + 1e-6; ++second) {
      out += ellipse(way, way.track.start + second, frame);
    }
  }
  return out;
}

}  // namespace saca::report
