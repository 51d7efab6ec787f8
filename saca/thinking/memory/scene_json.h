#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"

namespace saca::memory {

/// A scene as people read it: units in the keys, names for kinds. Angles are in radians, so that
/// every number comes back to the last bit. Schema "saca.scene/1", see docs/formats.md.
///
/// @throws ContractViolation  if the scene breaks a rule of `world::broken_rule`
[[nodiscard]] nlohmann::json to_json(const world::Scene& scene);

/// As a scene, and a record, hold them.
[[nodiscard]] nlohmann::json cues_json(std::span<const world::Cue> cues);

/// Strict: a key that is missing, unknown, of the wrong type or out of range is refused, and so is
/// a scene that breaks a rule of `world::broken_rule`.
/// @return  Error::Code::malformed, naming the key as "actors[2].speed", what was wanted, what came
[[nodiscard]] Result<world::Scene> scene_from_json(const nlohmann::json& json);

}  // namespace saca::memory
