#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/benchmarks/note.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::benchmarks {

/// A parked car in four dimensions, on 2.1 million points, as the tables of `saca run` are solved.
/// @param file  data/reach/parked_car.toml
/// @return  as danger::read_avoidance_case
[[nodiscard]] Result<danger::AvoidanceCase> parked_car_with_more_points(
    const std::filesystem::path& file);

struct AvoidanceTimes {
  nlohmann::json figures;
  danger::Solution solved;
};

/// reach.avoid4d.: seconds, points, steps, ns_per_point_stage, and of memory peak_mib, foretold_mib
/// and bytes_per_point.
/// @param parked  a case of four axes with one snapshot, at 1 s or later
/// @return  an error when a value is no number
[[nodiscard]] Result<AvoidanceTimes> avoidance_times(const danger::AvoidanceCase& parked,
                                                     const Clock& clock, const Note& note);

}  // namespace saca::benchmarks
