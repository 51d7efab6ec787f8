#pragma once

#include <optional>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/obstacle.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/danger.h"

/// What solved tables know of a state: of the point mass, beside one obstacle that keeps its
/// velocity.
namespace saca::learned_danger {

/// V_h [m]; nullopt: no table has it.
/// @param body  of the ego, about its centre of mass
[[nodiscard]] std::optional<double> exact_value(const danger::DangerModel& model,
                                                const world::Footprint& body, const State& state,
                                                const Obstacle& obstacle);

/// The demand after which the table's value is least, 0.2 s later (danger::by_look_ahead).
/// @param limits  of the car; the state's grip is taken
[[nodiscard]] std::optional<manoeuvre::Demand> exact_best(const danger::DangerModel& model,
                                                          danger::Avoidance limits,
                                                          const world::Footprint& body,
                                                          const State& state,
                                                          const Obstacle& obstacle);

}  // namespace saca::learned_danger
