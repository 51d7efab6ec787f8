#pragma once

#include <optional>

#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// Harm of each method with its interval; yardsticks that know the truth are grey.
[[nodiscard]] report::DotChart harm_chart(const SuiteResult& result);

/// All figures of all methods.
[[nodiscard]] report::PageTable figures_table(const SuiteResult& result);

/// Regret of each method in each family; the darker, the more is lost.
[[nodiscard]] report::PageTable families_table(const SuiteResult& result);

/// Recorded drivers beside the methods, in the encounters in which there was one; nullopt: none.
[[nodiscard]] std::optional<report::PageTable> drivers_table(const SuiteRun& run);

}  // namespace saca::suites
