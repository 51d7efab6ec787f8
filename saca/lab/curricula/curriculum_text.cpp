#include "saca/lab/curricula/curriculum_text.h"

#include <fmt/core.h>

#include "saca/lab/eval/estimate_text.h"

namespace saca::curricula {

using eval::curriculum_methods;
using eval::Episodes;
using eval::Learner;
using eval::with_interval;

namespace {

/// A line on what is left out; empty: nothing is.
std::string failures_text(const std::vector<Episodes>& all) {
  int left_out = 0;
  std::string first;
  for (const Episodes& episodes : all) {
    for (const eval::Episode& one : episodes.of) {
      if (!one.row.fault.empty()) {
        first = left_out == 0 ? one.row.fault : first;
        ++left_out;
      }
    }
  }
  return left_out == 0 ? ""
                       : fmt::format("{} episodes are left out; the first: {}\n", left_out, first);
}

}  // namespace

std::string text_of(const std::vector<Episodes>& all) {
  std::string text =
      fmt::format("{} encounters of each of {} seeds; means over seeds with 95 % intervals\n\n",
                  all.size(), all.front().of.size());
  constexpr const char* line = "{:10} {:26} {:26} {:>11} {:>8} {:>8} {:>8}\n";
  text += fmt::format(line, "", "harm", "regret", "worse than", "acts", "from", "cases");
  text += fmt::format(line, "", "", "", "AEB, %", "%", "memory,%", "");
  for (std::size_t m = 0; m < curriculum_methods.size(); ++m) {
    const auto of = [&](eval::EpisodeMeasure measure) { return eval::over_seeds(all, m, measure); };
    const auto percent = [&](eval::EpisodeMeasure measure) {
      return eval::percent_of(of(measure));
    };
    const bool remembers = m < eval::num_learners;
    text += fmt::format(
        line, curriculum_methods.at(m), with_interval(of(eval::episode_harm), 4),
        with_interval(of(eval::episode_regret), 4), percent(eval::episode_worse_than_aeb),
        percent(eval::episode_acts), remembers ? percent(eval::episode_from_memory) : "-",
        remembers ? fmt::format("{:.0f}", eval::mean_size(all.back(), static_cast<Learner>(m)))
                  : "-");
  }
  text += '\n';
  for (const eval::MethodPair& pair : eval::curriculum_pairs) {
    text += fmt::format("{} does {} more harm than {}\n", curriculum_methods.at(pair.method),
                        with_interval(eval::harm_over(all, pair), 5),
                        curriculum_methods.at(pair.other));
  }
  return text + failures_text(all);
}

}  // namespace saca::curricula
