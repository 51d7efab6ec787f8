#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring {

/// What a model predicts of some sequences.
struct ForecastSet {
  std::string model;               ///< what made them, in words
  std::vector<std::string> names;  ///< of the sequences, in the forecasts' order
  std::vector<Forecasts> forecasts;
};

/// Puts forecasts into an HDF5 file of format saca.forecasts/1 (docs/formats.md), in one step: so
/// models outside this library hand in what is to be scored.
///
/// @return  nullopt when it is on the disk, else the reason
/// @throws ContractViolation  if the set is empty or its parts do not fit together
[[nodiscard]] std::optional<Error> write_forecasts(const std::filesystem::path& path,
                                                   const ForecastSet& set);
/// @return  unreadable, or malformed: one line with the file, the part, what was wanted, what came
[[nodiscard]] Result<ForecastSet> read_forecasts(const std::filesystem::path& path);

/// The forecasts of these sequences, in their order.
/// @param source  name for messages, usually the path
/// @return  malformed if one is missing, or has another number of frames
[[nodiscard]] Result<std::vector<Forecasts>> forecasts_of(const ForecastSet& set,
                                                          std::span<const Sequence> sequences,
                                                          const std::string& source);

}  // namespace saca::intention_scoring
