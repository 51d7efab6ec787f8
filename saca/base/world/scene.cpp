#include "saca/base/world/scene.h"

#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/names.h"

namespace saca::world {
namespace {

constexpr std::array<std::string_view, 7> kind_names{
    "car", "van", "truck", "motorcycle", "bicycle", "pedestrian", "obstacle"};

// Nothing on a road is outside these; they keep predicted poses finite.
constexpr double most_position = 1e7;      // [m]
constexpr double most_yaw = 1e4;           // [rad], of which angles still have their digits
constexpr double most_speed = 200.0;       // [m/s]
constexpr double most_acceleration = 1e3;  // [m/s^2]
constexpr double most_yaw_rate = 100.0;    // [rad/s]
constexpr double least_size = 1e-3;        // [m]
constexpr double most_size = 1e3;          // [m]
constexpr double least_mass = 1e-3;        // [kg]
constexpr double most_mass = 1e7;          // [kg]
constexpr double most_time = 1e7;          // [s], of which motions still have their nanoseconds
constexpr double most_amount = 1e7;        // of a standard deviation or an age, whatever its unit
constexpr double most_curvature = 1.0;     // [1/m]

/// False for NaN.
bool within(Vec2 a, double most) {
  return std::abs(a.x) <= most && std::abs(a.y) <= most;
}

bool is_pose(const Pose& X) {
  return within(X.p, most_position) && std::abs(X.yaw) <= most_yaw;
}

/// Velocity and acceleration in one frame or the other.
bool is_motion(const Pose& X, Vec2 v, Vec2 a, double yaw_rate) {
  return is_pose(X) && within(v, most_speed) && within(a, most_acceleration) &&
         std::abs(yaw_rate) <= most_yaw_rate;
}

bool is_sized(const Footprint& footprint) {
  const bool has_width = footprint.shape != Shape::segment;
  const auto is_size = [](double size) { return size >= least_size && size <= most_size; };
  return is_size(footprint.length) &&
         (has_width ? is_size(footprint.width) : footprint.width == 0.0) &&
         std::abs(footprint.centre_x) <= most_size;
}

bool is_mass(double mass) {
  return mass >= least_mass && mass <= most_mass;
}

/// A standard deviation or an age.
bool is_amount(double amount) {
  return amount >= 0.0 && amount <= most_amount;
}

bool is_valid(const Road& road) {
  return is_pose(road.X_WL) && std::abs(road.curvature) <= most_curvature &&
         road.lane_width >= least_size && road.lane_width <= most_size && road.left_edge > 0.0 &&
         road.left_edge <= most_position && road.right_edge < 0.0 &&
         road.right_edge >= -most_position;
}

bool is_valid(const SharedControls& shared) {
  const auto is_pedal = [](const std::optional<double>& way) {
    return !way || (*way >= 0.0 && *way <= 1.0);
  };
  return (!shared.steering || std::abs(*shared.steering) <= 0.5 * std::numbers::pi) &&
         is_pedal(shared.throttle) && is_pedal(shared.brake);
}

}  // namespace

std::string_view name(ActorKind kind) {
  return name_of(kind, kind_names);
}

std::optional<ActorKind> actor_kind_from(std::string_view name) {
  return value_from<ActorKind>(name, kind_names);
}

std::string actor_name(const Actor& actor) {
  return std::string(name(actor.kind)) + std::to_string(actor.id);
}

std::optional<std::string_view> broken_rule(const Actor& actor) {
  if (!is_motion(actor.X_WA, actor.v_W, actor.a_W, actor.yaw_rate)) {
    return "an actor's motion is finite and at most 200 m/s, 1000 m/s^2, 100 rad/s";
  }
  if (!is_sized(actor.footprint) || !is_mass(actor.mass)) {
    return "an actor's length and width are 1 mm to 1 km, a segment's width 0, its mass 1 g to "
           "10,000 t";
  }
  if (actor.footprint.shape == Shape::segment && actor.kind != ActorKind::obstacle) {
    return "only an obstacle is a segment";
  }
  if (!is_amount(actor.position_sd) || !is_amount(actor.velocity_sd) || !is_amount(actor.age) ||
      !(actor.existence >= 0.0 && actor.existence <= 1.0)) {
    return "an actor's uncertainties and age are in [0, 1e7] and its existence is in [0, 1]";
  }
  if (!is_valid(actor.shared)) {
    return "shared steering is within 90 deg, shared pedals are in [0, 1]";
  }
  return std::nullopt;
}

std::optional<std::string_view> broken_rule(const Scene& scene) {
  const EgoState& ego = scene.ego;
  if (!(std::abs(scene.time) <= most_time)) {
    return "the time is within 1e7 s of 0";
  }
  if (!is_motion(ego.X_WB, ego.v_B, ego.a_B, ego.yaw_rate)) {
    return "the ego's motion is finite and at most 200 m/s, 1000 m/s^2, 100 rad/s";
  }
  if (!is_sized(scene.ego_footprint) || scene.ego_footprint.shape == Shape::segment ||
      !is_mass(scene.ego_mass)) {
    return "the ego's length and width are 1 mm to 1 km, its mass 1 g to 10,000 t";
  }
  if (!is_valid(scene.road)) {
    return "the road lies within 10,000 km, bends with at least 1 m, its lane is 1 mm to 1 km wide "
           "and "
           "its edges lie left and right of it";
  }
  if (!(scene.grip > 0.0 && scene.grip <= 1.2) || !is_amount(scene.grip_sd)) {
    return "grip is in (0, 1.2], its uncertainty in [0, 1e7]";
  }
  for (const Cue& cue : scene.cues) {
    if (!within(cue.p_W, most_position)) {
      return "cues lie within 10,000 km";
    }
  }
  for (const Actor& actor : scene.actors) {
    if (const auto rule = broken_rule(actor)) {
      return rule;
    }
    for (const Actor& other : scene.actors) {
      if (&other != &actor && other.kind == actor.kind && other.id == actor.id) {
        return "no two actors share a name";
      }
    }
  }
  return std::nullopt;
}

}  // namespace saca::world
