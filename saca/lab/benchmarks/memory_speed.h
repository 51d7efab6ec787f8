#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"

namespace saca::benchmarks {

/// Bytes per second that all threads move together: a = b + s c on arrays that no cache holds, two
/// read and one written (as STREAM counts them); the best of a few runs.
/// @param size  numbers of each array; a multiple of 64
[[nodiscard]] double memory_speed(int threads, const Clock& clock,
                                  std::size_t size = std::size_t{1} << 25);

/// How near a solver of two stages is to what the memory's speed allows: reach.memory_gb_per_s,
/// reach.bytes_per_point_stage and reach.roofline_share, 1 where it is as fast as numbers can be
/// moved.
/// @param speed  of the memory [bytes/s]
/// @param ns_per_point_stage  that the solver takes, in floats
[[nodiscard]] nlohmann::json roofline(double speed, double ns_per_point_stage);

}  // namespace saca::benchmarks
