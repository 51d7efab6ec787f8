#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::app {

/// Adds benchmarks::coarse_air3d_times. Its progress stands on the error stream.
/// @param root  holds data/
[[nodiscard]] std::optional<Error> bench_air3d(const std::filesystem::path& root,
                                               const Clock& clock, nlohmann::json& figures);

/// Likewise benchmarks::reach_times: all of `saca bench reach`.
[[nodiscard]] std::optional<Error> bench_reach(const std::filesystem::path& root,
                                               const manoeuvre::Car& car, const Clock& clock,
                                               nlohmann::json& figures);

}  // namespace saca::app
