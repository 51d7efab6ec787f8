#pragma once

#include <nlohmann/json.hpp>

#include "saca/base/world/scene.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::encounter {

// What a record and a trace tell alike; docs/formats.md.

[[nodiscard]] nlohmann::json road_json(const world::Road& road);

/// @param steering  of the road wheels [rad]
[[nodiscard]] nlohmann::json ego_json(const world::EgoState& ego, double steering);

/// Where an actor is and how fast it is.
[[nodiscard]] nlohmann::json actor_json(const world::Actor& actor);

/// Names and outlines of a scenario's actors.
[[nodiscard]] nlohmann::json actor_bodies_json(const scenario::Scenario& scenario);

}  // namespace saca::encounter
