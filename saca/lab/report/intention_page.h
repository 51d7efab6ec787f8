#pragma once

#include <string>
#include <vector>

#include "saca/lab/report/intention_chart.h"

namespace saca::report {

/// Samples side by side, to be judged by eye.
struct IntentionPage {
  std::string title;
  std::vector<std::string> lines;  ///< paragraphs below it
  std::vector<IntentionSample> samples;
};

/// @return  HTML that needs no other file; the same page makes the same bytes
/// @throws ContractViolation  as `intention_sample_part`
[[nodiscard]] std::string intention_page(const IntentionPage& page);

}  // namespace saca::report
