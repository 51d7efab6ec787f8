#include "saca/lab/policy_study/interruptible_survey.h"

#include "saca/base/core/clock.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::policy_study {

Result<std::optional<std::vector<eval::Finding>>> interruptible_survey(
    const eval::SurveyWork& work, const std::string& suite, long_work::ProgressDisplay display) {
  if (auto problem = long_work::make_folder_of(work.journal)) {
    return *std::move(problem);
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine progress("survey of " + suite, work.count, clock, display);
  return eval::survey(
      work, {.is_interrupted = long_work::interrupted, .progress = [&](int done, int before) {
               progress.show(done, before, " encounters");
             }});
}

}  // namespace saca::policy_study
