#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "saca/thinking/arbitration/event.h"

namespace saca::encounter {

/// What the verdict by which it was decided expected.
struct ExpectedAtDecision {
  double time = 0.0;          ///< of the decision [s]
  manoeuvre::Plan plan;       ///< what was decided on
  double harm = 0.0;          ///< expected of it
  double braking_harm = 0.0;  ///< of full braking
  int num_admissible = 0;     ///< how many plans were

  bool operator==(const ExpectedAtDecision&) const = default;
};

/// What was thought about the forecasts of one encounter, counted.
struct ThinkingFigures {
  int forecasts = 0;         ///< for which a plan was sought
  int recalled = 0;          ///< of these, those of which memory had a case above 70 % alike
  int from_memory = 0;       ///< those whose plan comes from memory in the end
  int from_model = 0;        ///< those whose plan comes from the language model
  int asked = 0;             ///< those about which the language model was asked
  int answered = 0;          ///< of these, with an answer before the trigger
  int ended = 0;             ///< of these, with a reply that came to its end by itself
  int statements = 0;        ///< of all replies, those that can be checked
  int false_statements = 0;  ///< of these
  int unfounded = 0;         ///< answered, with a choice that rests on something false
  /// The model's last answer about the forecast that the scene at the trigger is most like: over
  /// the eight policies; nullopt: it said nothing of it.
  std::optional<std::array<double, manoeuvre::num_policies>> answer;
  std::optional<ExpectedAtDecision>
      expected;  ///< nullopt: no verdict, or it says nothing of either

  bool operator==(const ThinkingFigures&) const = default;
};

[[nodiscard]] ThinkingFigures thinking_figures(std::span<const arbitration::Preview> previews,
                                               const std::optional<reflex::Decision>& decision);

/// Why this was decided, without numbers, so that equal reasons can be counted.
/// @param previews  all that was thought until then
[[nodiscard]] std::string reason_of(const reflex::Decision& decision,
                                    std::span<const arbitration::Preview> previews);

}  // namespace saca::encounter
