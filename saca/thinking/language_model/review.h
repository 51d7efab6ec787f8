#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/explanation.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// What an encounter came to.
struct Aftermath {
  /// The true scene at the trigger; its facts are what each policy leads to, the others' motion
  /// known. Nothing else of it is looked at.
  preview::Situation known;
  manoeuvre::Plan done;                 ///< begun at the trigger
  std::vector<manoeuvre::Plan> later;   ///< what took its place, one after the other
  std::optional<double> forecast_harm;  ///< of `done`, when it was decided; of no account where
                                        ///< another took its place
  collision::Outcome result;
  std::span<const world::Actor> met;  ///< those that the result's contacts count in
  manoeuvre::PolicyId best = manoeuvre::PolicyId::aeb;  ///< in hindsight
};

/// A model's evaluation after the encounter: text beside figures, which decides nothing.
struct Review {
  std::string prompt;
  std::string text;
  Truth truth;
  Explanation shown;  ///< what of it, or of a further try, is true; else the figures, in words
};

/// Asks what happened, which policy would have been best and by how much, and what to remember.
/// All figures stand in it (computed, not to be computed), of harm with four decimals.
[[nodiscard]] std::string review_prompt(const Aftermath& aftermath);

/// The reviews that are true (GBNF, as AskOptions::grammars wants it): what it came to, what was
/// forecast wrongly or what another policy would have led to, and the best. A model chooses among
/// them.
[[nodiscard]] std::string review_grammar(const Aftermath& aftermath);

/// What of a review is true, where that is its last statement too; else what happened in three
/// statements of the same figures.
[[nodiscard]] Explanation explanation(const Review& review, const Aftermath& aftermath);

}  // namespace saca::language_model
