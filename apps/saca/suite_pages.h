#pragma once

#include <optional>

#include "apps/saca/suite_running.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::app {

using suites::result_of;
using suites::SuiteResult;

/// The rows into `options.output`, the page beside them.
/// @return  nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_rows_and_page(const SuiteRun& run,
                                                       const SuiteResult& result,
                                                       const suites::SuiteRequest& options);

}  // namespace saca::app
