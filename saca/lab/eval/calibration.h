#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "saca/lab/eval/comparison.h"

namespace saca::eval {

using Probabilities = std::array<double, manoeuvre::num_policies>;

/// Which policies were right in hindsight: one at least.
using RightPolicies = std::array<bool, manoeuvre::num_policies>;

/// Those of which a plan, with whatever target speed, ends in the class of harm of the best plan
/// begun at T1: ties count.
/// @param comparison  in which T1 comes
[[nodiscard]] RightPolicies right_policies(const Comparison& comparison);

/// What somebody gave each policy, and which were right.
struct JudgedAnswer {
  Probabilities said;
  RightPolicies right;
};

/// p^(1 / temperature), to sum 1: softer above 1, sharper below.
/// @param temperature  > 0
[[nodiscard]] Probabilities tempered(const Probabilities& probabilities, double temperature);

/// -log of what the right policies were given together, per encounter. A probability of 0 counts as
/// 1e-12.
/// @param judged  at least one
[[nodiscard]] double log_loss(std::span<const JudgedAnswer> judged, double temperature);

/// The temperature of the least log_loss, from 1/20 to 20, to 0.1 %: the best of a scan, refined.
/// Source: Guo, Pleiss, Sun, Weinberger, On calibration of modern neural networks, ICML 2017.
/// @param judged  at least one
[[nodiscard]] double best_temperature(std::span<const JudgedAnswer> judged);

/// How often what the model gave a policy is how often that policy is right.
struct Calibration {
  int count = 0;            ///< answers
  double temperature = 1;   ///< by which its answers would have to be softened
  double log_loss = 0;      ///< with it
  double log_loss_now = 0;  ///< of its answers as they are
};
/// @return  nullopt where there is no answer
[[nodiscard]] std::optional<Calibration> calibrated(std::span<const JudgedAnswer> judged);

}  // namespace saca::eval
