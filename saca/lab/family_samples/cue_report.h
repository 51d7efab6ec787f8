#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "saca/lab/eval/cue_forecast.h"

namespace saca::family_samples {

// What `saca cues` tells: figures under "cues...." (docs/formats.md), and tables for a terminal.

/// How often there were cues of each kind, and how often what they stand for came.
[[nodiscard]] nlohmann::json json_of(const eval::CueCounts& counts);
/// Likewise, of the kinds that there were, with 95 % intervals.
[[nodiscard]] std::string text_of(const eval::CueCounts& counts);

/// How well each way of telling did in a suite's calibration split.
[[nodiscard]] nlohmann::json json_of(std::string_view suite,
                                     std::span<const eval::CueForecast> forecasts);
[[nodiscard]] std::string text_of(std::string_view suite,
                                  std::span<const eval::CueForecast> forecasts);

}  // namespace saca::family_samples
