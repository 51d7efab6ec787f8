#include "apps/saca/learn_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "saca/lab/report/chart_svg.h"

namespace saca::app {
namespace {

using eval::curriculum_methods;
using eval::Episode;
using eval::Episodes;
using eval::Estimate;
using eval::Learner;
using nlohmann::json;

struct NamedMeasure {
  const char* key;
  eval::EpisodeMeasure value;
};
constexpr std::array<NamedMeasure, 4> episode_measures{{
    {"harm", eval::episode_harm},
    {"regret", eval::episode_regret},
    {"materially_worse_than_aeb", eval::episode_worse_than_aeb},
    {"acts", eval::episode_acts},
}};

std::string key_of(const eval::MethodPair& pair, const std::string& block = "") {
  return fmt::format("{}.{}harm_over_{}", curriculum_methods.at(pair.method), block,
                     curriculum_methods.at(pair.other));
}

/// What only those who remember have.
void add_learner(json& out, const std::string& place, const std::vector<Episodes>& all,
                 std::size_t learner) {
  const encounter::ThinkingFigures thinking = eval::thought(all, learner);
  out[place + "forecasts"] = thinking.forecasts;
  out[place + "from_memory"] = thinking.from_memory;
  out[place + "asked_model"] = thinking.asked;
  out[place + "cases"] = eval::mean_size(all.back(), static_cast<Learner>(learner));
  out[place + "refuted"] = eval::count_episodes(
      all, [&](const Episode& one) { return one.refuted.at(learner).has_value(); });
}

}  // namespace

json learn_figures(const std::vector<Episodes>& all, const std::string& suite) {
  const std::string head = "learn." + suite + ".";
  const auto blocks = eval::blocks_of(all);
  json out;
  for (std::size_t m = 0; m < curriculum_methods.size(); ++m) {
    const std::string place = fmt::format("{}{}.", head, curriculum_methods.at(m));
    for (const NamedMeasure& measure : episode_measures) {
      add_estimate(out, place + measure.key, eval::over_seeds(all, m, measure.value));
    }
    if (m < eval::num_learners) {
      add_learner(out, place, all, m);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, fmt::format("{}block{}.regret", place, b + 1),
                   eval::over_seeds(blocks[b], m, eval::episode_regret));
    }
  }
  for (const eval::MethodPair& pair : eval::curriculum_pairs) {
    add_estimate(out, head + key_of(pair), eval::harm_over(all, pair));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, head + key_of(pair, fmt::format("block{}.", b + 1)),
                   eval::harm_over(blocks[b], pair));
    }
  }
  out[head + "lies"] = eval::count_episodes(all, eval::misleads);
  out[head + "episodes"] = all.size();
  out[head + "seeds"] = all.front().of.size();
  out[head + "faults"] =
      eval::count_episodes(all, [](const Episode& one) { return !one.row.fault.empty(); });
  return out;
}

std::string learn_curve(const std::vector<Episodes>& all, const std::string& suite) {
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
      line.points.push_back({middle, one.value});
      lost.y.high = std::max(lost.y.high, 1.1 * one.value);
      lost.y.low = std::min(lost.y.low, 1.1 * one.value);
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
  return report::chart_svg(
      {.heading = "Learning from encounters",
       .lines = {fmt::format("{}: {} encounters one after the other, mean of {} seeds, each with "
                             "encounters of its own",
                             suite, all.size(), all.front().of.size())},
       .charts = {std::move(lost), std::move(known)}});
}

void print_learnt(const std::vector<Episodes>& all) {
  app::print("{} encounters of each of {} seeds; means over seeds with 95 % intervals\n\n",
             all.size(), all.front().of.size());
  constexpr const char* line = "{:10} {:26} {:26} {:>11} {:>8} {:>8} {:>8}\n";
  app::print(line, "", "harm", "regret", "worse than", "acts", "from", "cases");
  app::print(line, "", "", "", "AEB, %", "%", "memory,%", "");
  for (std::size_t m = 0; m < curriculum_methods.size(); ++m) {
    const auto of = [&](eval::EpisodeMeasure measure) { return eval::over_seeds(all, m, measure); };
    const auto percent = [&](eval::EpisodeMeasure measure) {
      return fmt::format("{:.1f}", 100.0 * of(measure).value);
    };
    const bool remembers = m < eval::num_learners;
    app::print(line, curriculum_methods.at(m), with_interval(of(eval::episode_harm), 4),
               with_interval(of(eval::episode_regret), 4), percent(eval::episode_worse_than_aeb),
               percent(eval::episode_acts), remembers ? percent(eval::episode_from_memory) : "-",
               remembers
                   ? fmt::format("{:.0f}", eval::mean_size(all.back(), static_cast<Learner>(m)))
                   : "-");
  }
  app::print("\n");
  for (const eval::MethodPair& pair : eval::curriculum_pairs) {
    app::print("{} does {} more harm than {}\n", curriculum_methods.at(pair.method),
               with_interval(eval::harm_over(all, pair), 5), curriculum_methods.at(pair.other));
  }
}

}  // namespace saca::app
