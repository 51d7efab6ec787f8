#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/benchmarks/note.h"

namespace saca::benchmarks {

/// Points of the game air3D in x, y and heading.
struct GameGrid {
  int x = 0, y = 0, heading = 0;
};
constexpr GameGrid coarse_game{51, 40, 50};
constexpr GameGrid fine_game{101, 79, 100};

/// What hj_reachability has found, in doubles, on such a grid.
/// @param file  data/reference/air3d_hj_reachability.json
/// @return  an object with tube_volume_m2_rad, least_value_m and greatest_value_m;
///          Error::Code::unreadable, or malformed: there is no such solution
[[nodiscard]] Result<nlohmann::json> air3d_reference(const std::filesystem::path& file,
                                                     const GameGrid& size);

/// Times of the game to 2.8 s, beside the reference that is kept of it. By grid:
/// reach.air3d_GRID. with seconds.tN, the best of `repeats`, ns_per_point_stage.tN (N threads),
/// volume_error, least_value_error and greatest_value_error (share of the reference's); each with
/// .double where it is in doubles.
/// @param reference  as `air3d_reference` gives it
/// @return  an error when a value is no number
[[nodiscard]] Result<nlohmann::json> air3d_times(const GameGrid& size,
                                                 const nlohmann::json& reference, int repeats,
                                                 const Clock& clock, const Note& note);

}  // namespace saca::benchmarks
