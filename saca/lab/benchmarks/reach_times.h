#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/benchmarks/note.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::benchmarks {

/// The game air3D on the coarse grid (`air3d_times`), the best of two.
/// @param root  holds data/
/// @return  as air3d_reference and air3d_times
[[nodiscard]] Result<nlohmann::json> coarse_air3d_times(const std::filesystem::path& root,
                                                        const Clock& clock, const Note& note);

/// All of `saca bench reach`: the above on the fine grid too; a parked car in four dimensions,
/// as the tables of `saca run` are solved (`avoidance_times`); look-ups of a value and of a danger
/// (`look_up_times`, `risk_times`); and how near the four-dimensional solver is to what the
/// memory's speed allows (`roofline`).
/// @param root  holds data/
[[nodiscard]] Result<nlohmann::json> reach_times(const std::filesystem::path& root,
                                                 const manoeuvre::Car& car, const Clock& clock,
                                                 const Note& note);

}  // namespace saca::benchmarks
