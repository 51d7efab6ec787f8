#include "saca/onboard/atlas/atlas_point.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::atlas {
namespace {

constexpr double least_width = 2.0;  // lanes that `refusal` allows [m]
constexpr double most_width = 6.0;

}  // namespace

AtlasPoint point_of(const AtlasGrid& grid, std::size_t number) {
  std::size_t kind = 0;
  while (number >= grid[kind].num_nodes()) {
    number -= grid[kind].num_nodes();
    ++kind;
    expects(kind < num_atlas_kinds, "number < num_nodes(grid)");
  }
  const AtlasAxes& axes = grid[kind];
  AtlasPoint point{.kind = static_cast<AtlasKind>(kind)};
  point.share = axes.shares[number % axes.shares.size()];
  number /= axes.shares.size();
  point.way = axes.ways[number % axes.ways.size()];
  number /= axes.ways.size();
  point.grip = axes.grips[number % axes.grips.size()];
  point.speed = axes.speeds[number / axes.grips.size()];
  return point;
}

manoeuvre::Plan plan_of(const AtlasPoint& point) {
  switch (point.kind) {
    case AtlasKind::stop:
      return {.policy = manoeuvre::PolicyId::aeb, .strength = point.share};
    case AtlasKind::keep:
      return {manoeuvre::PolicyId::no_intervention, std::nullopt};
    case AtlasKind::swerve:
      return {manoeuvre::PolicyId::aes_left, std::nullopt};
    case AtlasKind::braked_swerve:
      return {manoeuvre::PolicyId::es_b_left, point.share * point.speed};
    case AtlasKind::swerve_stop:
      return {manoeuvre::PolicyId::es_b_left, 0.0};
    case AtlasKind::drift:
      break;
  }
  return {manoeuvre::PolicyId::t_drift_left, std::nullopt};
}

world::Scene scene_of(const manoeuvre::Car& car, const AtlasPoint& point) {
  world::Scene scene;
  scene.grip = point.grip;
  scene.ego.v_B = {point.speed, 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  if (point.way > 0.0) {
    scene.road.lane_width = std::clamp(point.way, least_width, most_width);
    scene.ego.X_WB.p.y = scene.road.lane_width - point.way;
  }
  return scene;
}

manoeuvre::Car unbounded(manoeuvre::Car car) {
  car.tuning.domain.slowest.fill(0.0);
  car.tuning.domain.fastest.fill(manoeuvre::fastest);
  return car;
}

AtlasTrace trace_of(const manoeuvre::EgoMotion& motion, double longest) {
  const std::vector<Pose>& X_LB = motion.track.X_WA;
  AtlasTrace trace{.step = motion.track.step};
  const auto most = static_cast<std::size_t>(std::ceil(longest / trace.step - 1e-9)) + 1;
  const std::size_t count = std::min(X_LB.size(), most);
  double heading = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    heading += wrap_angle(X_LB[i].yaw - heading);
    const Vec2 v_L = rotated(motion.v_B[i], X_LB[i].yaw);
    trace.look.push_back(
        {X_LB[i].p.x, X_LB[i].p.y - X_LB[0].p.y, heading, v_L.x, v_L.y, motion.yaw_rate[i]});
  }
  trace.ended = motion.ended && count == X_LB.size();
  trace.end = static_cast<double>(count - 1) * trace.step;
  return trace;
}

}  // namespace saca::atlas
