#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/danger_study/check_report.h"
#include "saca/lab/danger_study/coverage_report.h"
#include "saca/lab/danger_study/margin_report.h"
#include "saca/lab/installation/installation.h"

// What is asked of learnt danger by files' names (`saca danger`): all with progress on the error
// stream; Error::Code::too_late says that an interrupt came, which is to be watched for.

namespace saca::danger_study {

/// Situations that the car is driven in by weights.
struct SituationsRequest {
  std::string weights;  ///< safetensors file of saca-train-danger
  int situations = 20'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
};

/// How often weights are wrong, and of which car they are.
struct CheckedWeights {
  CheckReport report;
  std::string car_name;
};
[[nodiscard]] Result<CheckedWeights> check_weights(const installation::Installation& here,
                                                   const SituationsRequest& request);

/// Fits the margins of weights, and writes these with them.
/// @param output  empty: over the weights. Beside it stands what was counted until it is all, from
///                which the same request goes on
[[nodiscard]] Result<MarginReport> fit_margins(const installation::Installation& here,
                                               const SituationsRequest& request,
                                               const std::string& output);

/// How near a data set comes, and of which car it is.
struct DataSetCoverage {
  std::vector<learned_danger::Coverage> bins;
  std::string car_name;
};
/// @param task  its folder is that of the set
[[nodiscard]] Result<DataSetCoverage> coverage_in(const installation::Installation& here,
                                                  const CoverageTask& task);

/// The networks by which evasions of a data set are driven.
/// @param path  of weights; empty: none
/// @param car   its name, of which the weights must be
[[nodiscard]] Result<std::optional<learned_danger::Network>> network_by(
    const installation::Installation& here, const std::string& path, const std::string& car);

}  // namespace saca::danger_study
