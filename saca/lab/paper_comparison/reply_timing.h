#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::paper_comparison {

/// What SACA asks a model at first in an encounter.
struct FirstQuestion {
  language_model::Question question;
  double window = 0.0;  ///< from T2, or from when who threatens is first seen within it, to T1 [s]
};

/// What SACA asks a model at first in each of these encounters, if no answer ever came and there
/// were no memory: about up to three scenes. None of an encounter in which nothing is asked, or in
/// which T1 never comes.
/// @param saca  its model and memory are not asked
[[nodiscard]] std::vector<FirstQuestion> first_questions(
    std::span<const eval::SuiteEncounter> encounters, const eval::SuiteOptions& options,
    const runtime::PlanesSetup& saca, const intent::Model& intent);

/// How long replies are, and how long they take by the clock.
struct ReplyTimes {
  int asked = 0;  ///< forecasts
  int done = 0;   ///< of these, those about which the model had the last word: its reply ended, by
                  ///< itself or because it has as many tokens as it may
  int ended = 0;  ///< of these, by itself
  int in_time = 0;  ///< done within the window of the question
  /// Of replies that are done, from the question to the last answer, whatever else is asked with
  /// it. Means over questions of the mean of each: what is asked at once is no independent sample.
  eval::Estimate tokens;
  eval::Estimate seconds;
  std::optional<double> least_seconds;  ///< of all that are done
};

/// Puts the questions one after the other, at real pace, with nothing else going on in this
/// process.
/// @param clock     the model's
/// @param patience  with each question [s]
/// @param stop      no further question is put when a stop is asked for
/// @return          of what was asked until then; what went wrong if the model cannot be reached
[[nodiscard]] Result<ReplyTimes> timed_replies(language_model::LanguageModel& model,
                                               const Clock& clock,
                                               std::span<const FirstQuestion> questions,
                                               double patience, const std::stop_token& stop = {});

}  // namespace saca::paper_comparison
