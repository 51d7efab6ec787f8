#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/saca/suite_running.h"
#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/estimates.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::app {

using suites::add_estimate;
using suites::driver_figures;
using suites::DriverFigures;
using suites::footnotes_of;
using suites::percent_of;
using suites::result_of;
using suites::SuiteResult;
using suites::with_interval;

/// The page of a suite: what there is to see, in sentences; harm, all figures, families, where
/// decisions came from, and the encounters in which the first method lost most.
[[nodiscard]] report::SuitePage page_of(const SuiteRun& run, const SuiteResult& result,
                                        const SuiteCommandOptions& options);

/// The rows into `options.output`, the page beside them.
/// @return  nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_rows_and_page(const SuiteRun& run,
                                                       const SuiteResult& result,
                                                       const SuiteCommandOptions& options);

}  // namespace saca::app
