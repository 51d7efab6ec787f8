#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "saca/lab/recordings/commonroad.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

/// Fewest samples of a track that is packed: a second of NGSIM's.
constexpr std::size_t fewest_packed = 10;

/// The dynamic obstacles of a CommonRoad file with their places in its lanes (lane_map.h) and their
/// leads. A body that is in no lane for up to a second is still expected where it was, so that a
/// slit between two lanes hides no lane change.
///
/// The lead is who is nearest ahead with its centre in one of the lanelets that the lane goes on
/// in, at a fork in any of them. Where the map ends within lead_reach and nobody is seen before,
/// the gap is not known.
///
/// @param name     of the recording
/// @param skipped  counts what is left out: static obstacles, tracks shorter than fewest_packed
/// @return         group: left empty. Site: the benchmark's place in small letters, as in
///                 `USA_US101-1_1_T-1`: us101
[[nodiscard]] Recording recording_of_map(const CommonRoad& file, std::string name,
                                         std::map<std::string, std::size_t>& skipped);

}  // namespace saca::recordings
