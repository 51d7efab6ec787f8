#include "saca/lab/curricula/curriculum_text.h"

#include <fmt/core.h>

#include "saca/lab/eval/estimate_text.h"

namespace saca::curricula {

using eval::curriculum_methods;
using eval::Episodes;
using eval::Learner;
using eval::with_interval;

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
      return fmt::format("{:.1f}", 100.0 * of(measure).value);
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
  return text;
}

}  // namespace saca::curricula
