#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/cases/case_tools.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/lab/report/suite_page.h"

namespace saca::cases {

/// Which cases of a file are shown.
struct ShownOptions {
  std::string file;    ///< as messages and the page call it
  std::string family;  ///< empty: all
  std::string record;  ///< empty: drawn
  int count = 60;
  std::uint64_t seed = 1;  ///< by which they are drawn
};

/// So many of them, drawn evenly, in the file's order.
/// @return  out_of_range where there is none
[[nodiscard]] Result<std::vector<CrashCase>> shown_cases(const std::vector<CrashCase>& cases,
                                                         const ShownOptions& options);

/// A page of them: how many there are in the file, and a card of each.
/// @param all  of the file
/// @return     an error where an encounter cannot be drawn again
[[nodiscard]] Result<report::SuitePage> cases_page(const std::vector<CrashCase>& shown,
                                                   const std::vector<CrashCase>& all,
                                                   const ShownOptions& options,
                                                   const CaseTools& tools);

/// How many there are of each family, and which policies are the best in them.
[[nodiscard]] report::PageTable cases_table(const std::vector<CrashCase>& cases);

/// Document of `saca cases show --json`: schema saca.cases_page/1 (docs/formats.md).
/// @param page  its file
/// @param all   how many cases the file has
[[nodiscard]] nlohmann::json cases_page_json(const std::vector<CrashCase>& shown,
                                             const std::string& file, const std::string& page,
                                             std::size_t all);

}  // namespace saca::cases
