#pragma once

#include <array>
#include <span>

#include "saca/core/proportion.h"
#include "saca/eval/survey.h"
#include "saca/outcome/expected.h"

namespace saca::eval {

/// How good choices among the eight were, one made in each encounter.
struct ChoiceFigures {
  int count = 0;
  Proportion right;      ///< what was chosen is best in hindsight
  outcome::Mean harm;    ///< of what was chosen
  outcome::Mean regret;  ///< that harm above the best's
  Proportion contact;    ///< what was chosen meets somebody
  int quiet = 0;         ///< encounters in which doing nothing is best
  int needless = 0;      ///< of these, where something was done
};

/// What cannot be driven is carried out as SACA would: by emergency braking.
/// @param findings  two at least, all of which triggered
/// @param choices   one for each
[[nodiscard]] ChoiceFigures figures_of(std::span<const Finding> findings,
                                       std::span<const manoeuvre::PolicyId> choices);

using Probabilities = std::array<double, manoeuvre::num_policies>;

/// p^(1 / temperature), to sum 1: softer above 1, sharper below.
/// @param temperature  > 0
[[nodiscard]] Probabilities tempered(const Probabilities& probabilities, double temperature);

/// -log of what the best policies were given, per encounter. A probability of 0 counts as 1e-12.
[[nodiscard]] double log_loss(std::span<const Finding> findings,
                              std::span<const Probabilities> said, double temperature);

/// The temperature of the least log_loss, from 1/20 to 20; it is the only least one. Source: Guo,
/// Pleiss, Sun, Weinberger, On calibration of modern neural networks, ICML 2017.
[[nodiscard]] double best_temperature(std::span<const Finding> findings,
                                      std::span<const Probabilities> said);

}  // namespace saca::eval
