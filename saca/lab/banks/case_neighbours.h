#pragma once

#include <span>
#include <string>
#include <vector>

#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// One of those most like a case.
struct CaseNeighbour {
  const memory::Case* one = nullptr;
  double similarity = 0.0;  ///< in [0, 1]
  std::string differs;      ///< in what, the three largest parts, the largest first
};

/// The five cases most like a case, the most alike first; fewer where there are fewer.
/// @param all  of the bank, which outlives the result; `one` may be among them
[[nodiscard]] std::vector<CaseNeighbour> nearest_cases(const memory::Case& one,
                                                       std::span<const memory::Case> all);

}  // namespace saca::banks
