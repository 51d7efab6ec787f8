#pragma once

#include <string>
#include <vector>

#include "saca/lab/regulation/regulation_run.h"

namespace saca::regulation {

/// Why a cell was not passed, in a few words: "hits with 7.3 m/s"; empty where it was.
[[nodiscard]] std::string failure_of(const eval::CellResult& judged);

/// In which tests the paper's constant, full braking 1.3 s before the conflict, fails, and by how
/// much, in sentences; none when method "aeb" was not run.
[[nodiscard]] std::vector<std::string> constant_in_words(const RegulationRun& run);

}  // namespace saca::regulation
