#pragma once

#include "saca/lab/regulation/regulation_run.h"
#include "saca/lab/report/suite_page.h"

namespace saca::regulation {

/// Every cell as passed or failed: colour and words. Each method must be one of eval::methods().
[[nodiscard]] report::SuitePage page_of(const RegulationRun& run);

}  // namespace saca::regulation
