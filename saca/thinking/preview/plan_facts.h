#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::preview {

/// What a plan is expected to end in over what is not known of the others' places: read from the
/// atlas, which counts first contacts only.
struct ExpectedOutcome {
  collision::Outcome outcome;        ///< `harm` is the expected one, `contact` that at the mean
  double contact_probability = 0.0;  ///< with anybody, or an edge that stops the ego
};

/// What a plan ends in with full dynamics, in one future, with everything that follows a contact.
struct RolledOutcome {
  collision::Outcome outcome;
};

/// The plan cannot be driven.
struct Refusal {
  std::string why;
};

/// collision::better of two of a kind. An expectation and one future are not compared: the harm of
/// the one means something else than that of the other.
[[nodiscard]] bool better(const ExpectedOutcome& a, manoeuvre::PolicyId policy_a,
                          const ExpectedOutcome& b, manoeuvre::PolicyId policy_b);
[[nodiscard]] bool better(const RolledOutcome& a, manoeuvre::PolicyId policy_a,
                          const RolledOutcome& b, manoeuvre::PolicyId policy_b);
bool better(const ExpectedOutcome& a, manoeuvre::PolicyId policy_a, const RolledOutcome& b,
            manoeuvre::PolicyId policy_b) = delete;
bool better(const RolledOutcome& a, manoeuvre::PolicyId policy_a, const ExpectedOutcome& b,
            manoeuvre::PolicyId policy_b) = delete;

/// What one policy is forecast to end in; why it cannot be driven, where it cannot.
struct PolicyFacts {
  manoeuvre::Plan plan;
  std::variant<ExpectedOutcome, RolledOutcome, Refusal> end;

  [[nodiscard]] bool drivable() const { return !std::holds_alternative<Refusal>(end); }
  /// Why it cannot be driven.
  /// @throws ContractViolation  if it can
  [[nodiscard]] const std::string& refusal() const;
  /// Of either kind, for texts and records. What decides compares by `better` and `least_harm`.
  /// @throws ContractViolation  if it cannot be driven
  [[nodiscard]] const collision::Outcome& outcome() const;
  [[nodiscard]] collision::Outcome& outcome();
  /// Rolled out: 1 with any contact.
  /// @throws ContractViolation  if it cannot be driven
  [[nodiscard]] double contact_probability() const;
};

/// By the one ordering; what can be driven is better than what cannot.
/// @throws ContractViolation  if one is expected and the other rolled out
[[nodiscard]] bool better(const PolicyFacts& a, const PolicyFacts& b);

using AllFacts = std::array<PolicyFacts, manoeuvre::num_policies>;  ///< by PolicyId

/// Q_h of each policy (eq. 2; forecast_danger.h) [m], by PolicyId; less than 0: minus the room that
/// is left. nullopt: it cannot be driven, nobody is ahead, or V_h is not known.
using PolicyDangers = std::array<std::optional<double>, manoeuvre::num_policies>;

/// With full dynamics, all that can be driven.
[[nodiscard]] bool rolled_out(const AllFacts& facts);

/// Of those that can be driven; infinite where none can.
/// @throws ContractViolation  if some are expected and some rolled out
[[nodiscard]] double least_harm(const AllFacts& facts);

}  // namespace saca::preview
