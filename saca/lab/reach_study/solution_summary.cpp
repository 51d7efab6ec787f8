#include "saca/lab/reach_study/solution_summary.h"

#include <fmt/core.h>

#include <algorithm>

namespace saca::reach_study {

SolutionSummary summary_of(const std::string& file, const danger::Solution& solved,
                           double seconds) {
  const std::vector<float> values = danger::snapshot(solved, solved.times.size() - 1);
  const auto unsafe =
      std::count_if(values.begin(), values.end(), [](float v) { return v >= 0.0F; });
  return {.file = file,
          .cells = values.size(),
          .times = solved.times,
          .unsafe_share = static_cast<double>(unsafe) / static_cast<double>(values.size()),
          .seconds = seconds};
}

nlohmann::json json_of(const SolutionSummary& summary) {
  return {{"schema", "saca.reach_solve/1"},
          {"file", summary.file},
          {"cells", summary.cells},
          {"times_s", summary.times},
          {"unsafe_share", summary.unsafe_share},
          {"seconds", summary.seconds}};
}

std::string text_of(const SolutionSummary& summary) {
  return fmt::format("{}: {} cells, to {:g} s, {:.2f} % of them unsafe; {:.1f} s\n", summary.file,
                     summary.cells, summary.times.back(), 100.0 * summary.unsafe_share,
                     summary.seconds);
}

}  // namespace saca::reach_study
