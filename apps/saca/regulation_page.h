#pragma once

#include <string>
#include <vector>

#include "apps/saca/regulation_running.h"
#include "saca/lab/report/suite_page.h"

namespace saca::app {

/// In which tests the paper's constant, full braking 1.3 s before the conflict, fails, and by how
/// much; empty when method "aeb" was not run.
[[nodiscard]] std::vector<std::string> constant_in_words(const RegulationRun& run);

/// Every cell as passed or failed: colour and words.
[[nodiscard]] report::SuitePage page_of(const RegulationRun& run);

}  // namespace saca::app
