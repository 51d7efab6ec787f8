#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/sequence.h"
#include "saca/lab/intention_scoring/simulated_drive.h"

namespace saca::intention_scoring {

/// A simulated vehicle as somebody sees it, with what it truly does.
///
/// Labels: `labels_of` the true motion. What is seen: the true motion through
/// `sim::Perception`, its accelerations and turning rates backward differences over 0.5 s, as in a
/// simulated encounter. Pedals and steering run 0.15 s ahead of what they cause.
/// @param seed  of the errors of perception
[[nodiscard]] Sequence simulated_sequence(const DrivePlan& plan, std::uint64_t seed,
                                          const std::string& name);

/// Vehicles of a seed, each a group of its own: what recordings hardly hold, LB and RB, and hard
/// braking, is there in plenty. The same for any number of threads.
/// @param threads  >= 1
[[nodiscard]] std::vector<Sequence> simulated_sequences(std::size_t count, std::uint64_t seed,
                                                        int threads);

}  // namespace saca::intention_scoring
