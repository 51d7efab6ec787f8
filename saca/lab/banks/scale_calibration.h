#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/banks/recall_calibration.h"
#include "saca/lab/eval/scale_fit.h"
#include "saca/lab/long_work/progress.h"

namespace saca::banks {

/// How well the harm in cases to check is predicted (eval::scale_error).
struct CheckError {
  double shipped = 0.0;  ///< with the scales that are shipped
  double fitted = 0.0;
};

/// The scales of what makes a difference between scenes, fitted to cases.
struct ScaleCalibration {
  eval::ScaleFit fit;
  std::optional<CheckError> check;  ///< nullopt: there is nothing to be predicted
};

struct ScaleFitOptions {
  int scenes = 2'000;  ///< how many are predicted in each try, at most, > 0
  int threads = 1;     ///< they do not change the result
};

/// An interrupt ends it with the best scales so far.
/// @return  malformed, naming the file, where no case tells what was expected
[[nodiscard]] Result<ScaleCalibration> calibrate_scales(const CalibrationCases& cases,
                                                        const ScaleFitOptions& options,
                                                        long_work::ProgressLine& progress);

/// What `saca memory calibrate --fit --json` prints: figures whose names begin with
/// "memory.scales.".
/// @param version  of the program
[[nodiscard]] nlohmann::json json_of(const ScaleCalibration& calibration,
                                     const std::string& version);

/// The same as a table for people.
[[nodiscard]] std::string text_of(const ScaleCalibration& calibration);

}  // namespace saca::banks
