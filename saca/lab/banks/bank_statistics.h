#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/thinking/memory/coverage.h"

namespace saca::banks {

/// What encounters a bank knows, and what it costs.
struct BankStatistics {
  std::string name;
  std::size_t num_cases = 0;
  double load = 0.0;           ///< to open it [s]
  double recall_median = 0.0;  ///< to ask it [us]; 0 where there is no case
  double recall_p99 = 0.0;     ///< likewise
  std::vector<memory::CoverageCell> cells;
};

/// Opens an existing bank and measures it. Asked is each case's own scene, without the case; of
/// many cases about a thousand.
/// @return  as memory::Store::open_existing and all
[[nodiscard]] Result<BankStatistics> bank_statistics(const std::string& file, const Clock& clock);

/// What `saca memory stats` prints: schema "saca.memory_stats/1", and for people.
[[nodiscard]] nlohmann::json json_of(const BankStatistics& statistics);
[[nodiscard]] std::string text_of(const BankStatistics& statistics);

}  // namespace saca::banks
