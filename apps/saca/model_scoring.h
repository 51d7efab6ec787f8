#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/saca/surveying.h"
#include "saca/core/result.h"
#include "saca/eval/choices.h"
#include "saca/manoeuvre/plan.h"
#include "saca/reason/language_model.h"

namespace saca::app {

struct ScoreOptions {
  SurveyOptions survey;
  std::string model = "local";
  bool as_json = false;
};

/// What was said about one prompt.
struct Said {
  eval::Probabilities first{};  ///< at once
  eval::Probabilities last{};   ///< after reasoning
  bool ended = false;           ///< the text came to its end by itself
  int checked = 0;              ///< statements
  int wrong = 0;
  bool unfounded = false;  ///< the choice rests on something false
  bool valid = true;       ///< there was an answer; else braking stands for it, eight alike
};

/// One encounter in which a model was asked.
struct Score {
  eval::Finding finding;
  manoeuvre::PolicyId by_forecast{};  ///< the best
  manoeuvre::PolicyId as_saca{};  ///< the model's choice with facts, where it passes SACA's checks
  Said with_facts;
  Said without_facts;
};

[[nodiscard]] manoeuvre::PolicyId likeliest(const eval::Probabilities& probabilities);

/// Asks in one encounter after the other until enough were asked about: of each the forecast that
/// came nearest to what happened, with our facts and without. Each is noted in a journal, from
/// which the same command goes on.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<std::vector<Score>>> score_all(const SuiteSource& source,
                                                                  reason::LanguageModel& model,
                                                                  const ScoreOptions& options);

}  // namespace saca::app
