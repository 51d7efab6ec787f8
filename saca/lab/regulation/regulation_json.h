#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/regulation/regulation_run.h"

namespace saca::regulation {

/// The figures of a run under "suite.NAME...." and all its cells (docs/formats.md: What a
/// regulation asks). There must be a cell of each car and row.
[[nodiscard]] nlohmann::json json_of(const RegulationRun& run);

}  // namespace saca::regulation
