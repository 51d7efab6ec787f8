#pragma once

#include <string>

#include "saca/lab/banks/recall_calibration.h"

namespace saca::banks {

/// How often recalls of each tenth of confidence transfer, as an SVG: of the cases to check, where
/// there are any.
[[nodiscard]] std::string recall_chart(const RecallCalibration& calibration);

}  // namespace saca::banks
