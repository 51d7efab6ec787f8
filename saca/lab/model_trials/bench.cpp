#include "saca/lab/model_trials/bench.h"

#include "saca/base/core/contract.h"

namespace saca::model_trials {

Result<Bench> bench_of(language_model::LanguageModel& model, int runs, const Clock& clock) {
  expects(runs >= 1, "runs >= 1");
  Bench bench;
  if (const auto* const child = dynamic_cast<const language_model::ChildModel*>(&model)) {
    bench.load = child->figures().load_time;
  }
  const language_model::Question three = example_question();
  const language_model::Question one{{three.scenes[0]}, {three.grammars[0]}};
  for (int run = 0; run < runs; ++run) {
    bench.one.push_back(timed_question(model, one, without_haste, clock));
    if (const auto& error = bench.one.back().error) {
      return *error;
    }
    bench.three.push_back(timed_question(model, three, preview_time, clock));
  }
  return bench;
}

}  // namespace saca::model_trials
