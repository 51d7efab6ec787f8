#pragma once

#include <optional>
#include <string_view>

#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// A method's row of a chart: its title, a figure with its interval and the mean beside; grey where
/// it knows the truth.
/// @param method  a name of eval::methods()
/// @param digits  of the mean, after the point
[[nodiscard]] report::DotRow method_dot(std::string_view method, const eval::Estimate& figure,
                                        int digits);

/// Harm of each method with its interval; yardsticks that know the truth are grey.
[[nodiscard]] report::DotChart harm_chart(const SuiteResult& result);

/// All figures of all methods.
[[nodiscard]] report::PageTable figures_table(const SuiteResult& result);

/// Regret of each method in each family; the darker, the more is lost.
[[nodiscard]] report::PageTable families_table(const SuiteResult& result);

/// Recorded drivers beside the methods, in the encounters in which there was one; nullopt: none.
[[nodiscard]] std::optional<report::PageTable> drivers_table(const SuiteRun& run);

}  // namespace saca::suites
