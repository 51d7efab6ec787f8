#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::app {

/// Times of the game air3D to 2.8 s on 51 x 40 x 50 points, beside the reference that is kept of
/// it. By grid: reach.air3d_GRID. with seconds.tN, the best of a few, ns_per_point_stage.tN (N
/// threads), volume_error, least_value_error and greatest_value_error (share of the reference's);
/// each with .double where it is in doubles.
/// @param root  holds data/
[[nodiscard]] std::optional<Error> bench_air3d(const std::filesystem::path& root,
                                               const Clock& clock, nlohmann::json& figures);

/// All of `saca bench reach`: the above on the fine grid too; a parked car in four dimensions,
/// as the tables of `saca run` are solved (reach.avoid4d.); look-ups of a value and of a danger
/// (reach.lookup_us., reach.risk_us.); and how near the four-dimensional solver is to what the
/// memory's speed allows (reach.roofline_share: 1 is as fast as numbers can be moved). What it is
/// at is told on the error stream.
[[nodiscard]] std::optional<Error> bench_reach(const std::filesystem::path& root,
                                               const manoeuvre::Car& car, const Clock& clock,
                                               nlohmann::json& figures);

}  // namespace saca::app
