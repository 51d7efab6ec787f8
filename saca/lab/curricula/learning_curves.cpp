#include "saca/lab/curricula/learning_curves.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

namespace saca::curricula {

using eval::curriculum_methods;
using eval::Episodes;
using eval::Estimate;

report::ChartSheet learning_curves(const std::vector<Episodes>& all, const std::string& suite) {
  using report::ChartColour;
  constexpr std::array<ChartColour, curriculum_methods.size()> colours{
      ChartColour::grey,   ChartColour::blue,  ChartColour::orange,
      ChartColour::purple, ChartColour::green, ChartColour::ink};
  report::LineChart lost{
      .title = "Harm above the best of all plans begun at T1",
      .x = {.name = "encounters met", .low = 0.0, .high = static_cast<double>(all.size())},
      .y = {.name = "regret", .low = 0.0, .high = 0.0},
      .curves = {}};
  report::LineChart known{.title = "Forecasts whose plan comes from memory",
                          .x = lost.x,
                          .y = {.name = "share", .unit = "%", .low = 0.0, .high = 100.0},
                          .curves = {}};
  for (std::size_t m = 0; m < curriculum_methods.size(); ++m) {
    report::ChartLine line{.name = std::string(curriculum_methods.at(m)),
                           .colour = colours.at(m),
                           .dashed = m >= eval::num_learners,
                           .points = {}};
    report::ChartLine share = line;
    double met = 0.0;
    for (const auto& block : eval::blocks_of(all)) {
      const double middle = met + 0.5 * static_cast<double>(block.size());
      met += static_cast<double>(block.size());
      const Estimate one = eval::over_seeds(block, m, eval::episode_regret);
      if (one.n > 0) {
        line.points.push_back({middle, one.value});
        lost.y.high = std::max(lost.y.high, 1.1 * one.value);
        lost.y.low = std::min(lost.y.low, 1.1 * one.value);
      }
      const Estimate answered = eval::over_seeds(block, m, eval::episode_from_memory);
      if (answered.n > 0) {
        share.points.push_back({middle, 100.0 * answered.value});
      }
    }
    lost.curves.push_back(std::move(line));
    if (m < eval::num_learners) {
      known.curves.push_back(std::move(share));
    }
  }
  lost.y.high = lost.y.high > 0.0 ? lost.y.high : 1.0;
  return {
      .heading = "Learning from encounters",
      .lines = {fmt::format("{}: {} encounters one after the other, mean of {} seeds, each with "
                            "encounters of its own",
                            suite, all.size(), all.front().of.size())},
      .charts = {std::move(lost), std::move(known)}};
}

}  // namespace saca::curricula
