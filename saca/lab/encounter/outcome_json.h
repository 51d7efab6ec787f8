#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "saca/base/world/scene.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::encounter {

// What something ends in, as records tell it; docs/formats.md. `actors` are those that indices of
// an outcome count in.

[[nodiscard]] nlohmann::json contact_json(const collision::Contact& contact,
                                          std::span<const world::Actor> actors);

/// The first contact, or null.
[[nodiscard]] nlohmann::json first_contact_json(const collision::Outcome& outcome,
                                                std::span<const world::Actor> actors);

/// Whom or what it is clear of, and when it is nearest; or null.
[[nodiscard]] nlohmann::json nearest_json(const collision::Outcome& outcome,
                                          std::span<const world::Actor> actors);

[[nodiscard]] nlohmann::json outcome_json(const collision::Outcome& outcome,
                                          std::span<const world::Actor> actors);

}  // namespace saca::encounter
