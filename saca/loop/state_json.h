#pragma once

#include <nlohmann/json.hpp>

#include "saca/sim/scenario.h"
#include "saca/world/scene.h"

namespace saca::loop {

// What a record and a trace tell alike; docs/formats.md.

[[nodiscard]] nlohmann::json road_json(const world::Road& road);

/// @param steering  of the road wheels [rad]
[[nodiscard]] nlohmann::json ego_json(const world::EgoState& ego, double steering);

/// Where an actor is and how fast it is.
[[nodiscard]] nlohmann::json actor_json(const world::Actor& actor);

/// Names and outlines of a scenario's actors.
[[nodiscard]] nlohmann::json actor_bodies_json(const sim::Scenario& scenario);

}  // namespace saca::loop
