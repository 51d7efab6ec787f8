#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/coverage.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger_study {

/// How much of a data set is gone through.
struct CoverageTask {
  std::string folder;           ///< of the data set, for messages
  std::size_t states = 200;     ///< of each bin, whose best inputs are looked for, at most
  std::size_t others = 20'000;  ///< likewise, among which
  int threads = usual_threads();
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// How near the inputs of a data set come to the exact best ones, with progress on the error
/// stream.
/// @param first  of the parts, read already
/// @param files  of all parts
/// @param car    that the parts are of
/// @param model  with the tables that know the best input
/// @return  Error::Code::too_late: interrupted, which is to be watched for; out_of_range: no state
///          is known; as learned_danger::read_part_of
[[nodiscard]] Result<std::vector<learned_danger::Coverage>> coverage_of(
    const learned_danger::Part& first, const std::vector<std::filesystem::path>& files,
    const manoeuvre::Car& car, const danger::DangerModel& model, const CoverageTask& task);

/// danger.coverage.BIN.: median, p90, states, others.
[[nodiscard]] nlohmann::json json_of(const std::vector<learned_danger::Coverage>& all);

/// A table with a line for each bin.
[[nodiscard]] std::string text_of(const std::vector<learned_danger::Coverage>& all);

}  // namespace saca::danger_study
