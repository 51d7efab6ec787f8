#pragma once

#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/model_trials/question_timing.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::model_trials {

constexpr double preview_time = 4.2;    ///< [s]: T2 - T1 of the paper
constexpr double without_haste = 60.0;  ///< [s]

/// How fast a model answers.
struct Bench {
  std::vector<QuestionTiming> one;    ///< about one forecast, without haste
  std::vector<QuestionTiming> three;  ///< about three, within `preview_time`
  double load = 0.0;                  ///< of a child process, from its start until it was ready [s]
};

/// Asks so many times about one forecast, and as often about three.
/// @param runs   >= 1
/// @param clock  of the model
/// @return       the model's error where it does not answer about one
[[nodiscard]] Result<Bench> bench_of(language_model::LanguageModel& model, int runs,
                                     const Clock& clock);

}  // namespace saca::model_trials
