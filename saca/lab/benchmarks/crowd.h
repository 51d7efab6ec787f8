#pragma once

#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::benchmarks {

constexpr int num_crowds = 64;

/// `num_crowds` scenes of an ego at about 20 m/s with others ahead on three lanes at about 11 m/s,
/// each a little otherwise; the same in every call.
/// @param num_actors  at most world::max_actors
[[nodiscard]] std::vector<world::Scene> crowds(const manoeuvre::Car& car, int num_actors);

/// Puts the last of each scene's actors 20 m behind the ego, as fast as that.
void follow_ego(std::vector<world::Scene>& scenes);

}  // namespace saca::benchmarks
