#include "saca/world/scene.h"

#include <array>
#include <cmath>

#include "saca/core/names.h"

namespace saca::world {
namespace {

constexpr std::array<std::string_view, 7> kind_names{
    "car", "van", "truck", "motorcycle", "bicycle", "pedestrian", "obstacle"};

bool is_sized(const Footprint& footprint) {
  return std::isfinite(footprint.length) && footprint.length > 0.0 &&
         std::isfinite(footprint.width) && footprint.width > 0.0 &&
         std::isfinite(footprint.centre_x);
}

bool is_mass(double mass) {
  return std::isfinite(mass) && mass > 0.0;
}

/// A standard deviation or an age.
bool is_amount(double amount) {
  return std::isfinite(amount) && amount >= 0.0;
}

bool is_valid(const Road& road) {
  return is_finite(road.X_WL) && std::isfinite(road.curvature) && std::isfinite(road.lane_width) &&
         road.lane_width > 0.0 && std::isfinite(road.left_edge) && road.left_edge > 0.0 &&
         std::isfinite(road.right_edge) && road.right_edge < 0.0;
}

std::optional<std::string_view> broken_rule(const Actor& actor) {
  if (!is_finite(actor.X_WA) || !is_finite(actor.v_W) || !is_finite(actor.a_W) ||
      !std::isfinite(actor.yaw_rate)) {
    return "an actor's motion is finite";
  }
  if (!is_sized(actor.footprint) || !is_mass(actor.mass)) {
    return "an actor's length, width and mass are > 0";
  }
  if (!is_amount(actor.position_sd) || !is_amount(actor.velocity_sd) || !is_amount(actor.age) ||
      !(actor.existence >= 0.0 && actor.existence <= 1.0)) {
    return "an actor's uncertainties are >= 0 and its existence is in [0, 1]";
  }
  return std::nullopt;
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

std::optional<std::string_view> broken_rule(const Scene& scene) {
  if (!std::isfinite(scene.time) || !is_finite(scene.ego.X_WB) || !is_finite(scene.ego.v_B) ||
      !is_finite(scene.ego.a_B) || !std::isfinite(scene.ego.yaw_rate)) {
    return "the ego's motion is finite";
  }
  if (!is_sized(scene.ego_footprint) || !is_mass(scene.ego_mass)) {
    return "the ego's length, width and mass are > 0";
  }
  if (!is_valid(scene.road)) {
    return "the road is finite, its lane has a width and its edges lie left and right of it";
  }
  if (!(scene.grip > 0.0 && scene.grip <= 1.2) || !is_amount(scene.grip_sd)) {
    return "grip is in (0, 1.2]";
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
