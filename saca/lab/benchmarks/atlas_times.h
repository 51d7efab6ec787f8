#pragma once

#include <nlohmann/json_fwd.hpp>

#include "saca/base/core/clock.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::benchmarks {

/// Percentiles [us] of all eight policies read from the atlas and judged: atlas.futures_us, with 1,
/// 8 and 32 others, who are known exactly or with their spread (.spread), with one target speed or
/// with four (.targets4); and the share of calls that the atlas does not hold, atlas.outside_share.
/// @param num_calls  of each, > 0
[[nodiscard]] nlohmann::json atlas_times(const manoeuvre::Car& car, const atlas::Atlas& atlas,
                                         const collision::HarmModel& harm, const Clock& clock,
                                         int num_calls);

}  // namespace saca::benchmarks
