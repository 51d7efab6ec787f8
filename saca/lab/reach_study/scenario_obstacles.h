#pragma once

#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/thinking/danger/danger_cases.h"

namespace saca::reach_study {

/// Bodies of all actors, ghosts too, with the speeds that they have, looked at again and again
/// while the ego stands at its start: for which tables of danger a scenario asks.
/// @param ego  its body, about its centre of mass
[[nodiscard]] std::vector<danger::ObstacleKind> obstacles_of(const scenario::Scenario& scenario,
                                                             const world::Footprint& ego);

}  // namespace saca::reach_study
