#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/danger_study/check_situations.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::danger_study {

/// What was counted for margins so far: what an interrupted count goes on from.
struct MarginCount {
  int situations = 0;
  std::array<learned_danger::PredictedSafe, learned_danger::num_bins> told;
};

/// Schema `saca.margins/2`.
/// @param of  names weights and seed
[[nodiscard]] nlohmann::json json_of(const MarginCount& count, const std::string& of);

/// And back; none was made yet where there is no file.
/// @return  Error::Code::malformed: the file is no count, or of other weights or another seed;
///          unreadable
[[nodiscard]] Result<MarginCount> read_margin_count(const std::filesystem::path& path,
                                                    const std::string& of);

/// Counts on until there are as many situations as the task wants, with progress on the error
/// stream, and writes to `path` what was counted every few seconds.
/// @param count  where it goes on from, as `read_margin_count` has it
/// @param of     as it was asked for
/// @return  Error::Code::too_late: interrupted, which is to be watched for; unwritable
[[nodiscard]] Result<MarginCount> counted_on(MarginCount count, const std::string& of,
                                             const std::filesystem::path& path,
                                             const manoeuvre::Car& car,
                                             const learned_danger::Network& network,
                                             const SituationsTask& task);

/// "weights 0123456789abcdef, seed 1"
[[nodiscard]] std::string margin_count_of(const learned_danger::Network& network,
                                          std::uint64_t seed);

}  // namespace saca::danger_study
