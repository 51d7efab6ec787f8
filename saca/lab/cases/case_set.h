#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/cases/case_making.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/thinking/memory/case.h"

namespace saca::cases {

/// What all rows came to.
struct CaseSet {
  std::vector<CrashCase> cases;       ///< in the order of the rows, numbered from 1 on
  std::vector<std::string> problems;  ///< why records could not be played
};
[[nodiscard]] CaseSet case_set(std::vector<CaseRow> rows);

/// The same without their records, as a memory takes them.
[[nodiscard]] std::vector<memory::Case> memory_cases(const std::vector<CrashCase>& cases);

/// Of those whose driver was recorded, with what he did in the place of what was best: for an
/// imitator to learn from, not for a memory.
[[nodiscard]] std::vector<memory::Case> driver_cases(const std::vector<CrashCase>& cases);

/// Where cases are written to.
struct CaseOutputs {
  std::string cases;
  std::string memory;   ///< likewise as a memory takes them; empty: not written
  std::string drivers;  ///< those of driver_cases; empty: not written
};
/// @return  nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_cases(const CaseOutputs& outputs,
                                               const std::vector<CrashCase>& cases);

}  // namespace saca::cases
