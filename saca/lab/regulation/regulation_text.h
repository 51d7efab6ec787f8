#pragma once

#include <string>

#include "saca/lab/regulation/regulation_run.h"

namespace saca::regulation {

/// How many tests each method passes, by row and by car, and what becomes of full braking at T1,
/// for a terminal.
[[nodiscard]] std::string text_of(const RegulationRun& run);

}  // namespace saca::regulation
