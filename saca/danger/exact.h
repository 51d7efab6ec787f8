#pragma once

#include <optional>

#include "saca/danger/obstacle.h"
#include "saca/danger/state.h"
#include "saca/manoeuvre/demand.h"
#include "saca/reach/avoidance.h"
#include "saca/reach/danger.h"
#include "saca/world/footprint.h"

/// What solved tables know of a state: of the point mass, beside one obstacle that keeps its
/// velocity.
namespace saca::danger {

/// V_h [m]; nullopt: no table has it.
/// @param body  of the ego, about its centre of mass
[[nodiscard]] std::optional<double> exact_value(const reach::DangerModel& model,
                                                const world::Footprint& body, const State& state,
                                                const Obstacle& obstacle);

/// The demand after which the table's value is least, 0.2 s later (reach::by_look_ahead).
/// @param limits  of the car; the state's grip is taken
[[nodiscard]] std::optional<manoeuvre::Demand> exact_best(const reach::DangerModel& model,
                                                          reach::Avoidance limits,
                                                          const world::Footprint& body,
                                                          const State& state,
                                                          const Obstacle& obstacle);

}  // namespace saca::danger
