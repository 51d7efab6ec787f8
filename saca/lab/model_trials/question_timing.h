#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::model_trials {

/// Three forecasts that differ as previews do: in what the truck does, and what that leads to.
[[nodiscard]] language_model::Question example_question();

/// What one question took.
struct QuestionTiming {
  double first = 0.0;  ///< until each scene had its first answer [s]
  double whole = 0.0;  ///< until the call returned [s]
  int missing = 0;     ///< scenes without any answer
  int forced = 0;      ///< scenes whose reply the deadline or the length cut
  std::vector<language_model::Reply> replies;
  std::optional<Error> error;                 ///< of the whole question
  language_model::ChildModelFigures figures;  ///< where the model is a child process
};

/// Puts a question, and takes the time.
/// @param budget  until the last answer [s]
/// @param clock   of the model
[[nodiscard]] QuestionTiming timed_question(language_model::LanguageModel& model,
                                            const language_model::Question& question, double budget,
                                            const Clock& clock);

}  // namespace saca::model_trials
