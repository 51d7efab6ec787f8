#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/state.h"

namespace saca::learned_danger {

/// Who is farther is told as so far: neither V nor h need be known beyond [m].
constexpr double farthest_told = 15.0;

/// h or V as the networks learn it: not below -farthest_told [m].
[[nodiscard]] inline double told(double value) {
  return value > -farthest_told ? value : -farthest_told;
}

constexpr std::size_t num_net_inputs = 47;
/// What the networks read of the ego and one obstacle: numbers about as large as 1.
using NetInputs = std::array<float, num_net_inputs>;

/// The ego and one obstacle of an observation: its motion in the ego's frame, h now and where it
/// leads in half a second, one and two if the ego keeps its velocity and the obstacle goes on, when
/// and by how much they then pass, what of the grip stopping before it takes, and where h leads if
/// the ego brakes, turns or does both, with all the grip.
struct SeenByNet {
  NetInputs inputs;
  double h = 0.0;  ///< of this obstacle alone [m]
};
/// @param body      of the ego, about its centre of mass
/// @param obstacle  of the observation, one that is there
/// @param shape     that it has, which an observation does not say
[[nodiscard]] SeenByNet seen_by_net(const world::Footprint& body, const Observation& seen,
                                    std::size_t obstacle, world::Shape shape = world::Shape::box);

/// The same seen in a mirror: these change their sign.
[[nodiscard]] const std::vector<std::size_t>& mirrored_inputs();

/// What the networks read of two obstacles: the inputs of that whose V_h is higher, those of the
/// other, and both V_h.
constexpr std::size_t num_pair_inputs = 2 * num_net_inputs + 2;
constexpr float pair_value_scale = 0.2F;  ///< of V_h among them [1/m]

constexpr double pair_counts_from = -10.0;  ///< [m]
constexpr double pair_share_slope = 0.2;    ///< [1/m]
/// How much of what is learnt of a pair counts: nothing where the one that is less dangerous can be
/// passed at 10 m or more, all from 5 m on.
/// @param v  the lower of both V_h [m]
[[nodiscard]] inline double pair_share(double v) {
  return std::clamp(pair_share_slope * (v - pair_counts_from), 0.0, 1.0);
}

}  // namespace saca::learned_danger
