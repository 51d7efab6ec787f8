#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "saca/lab/eval/decision_point.h"
#include "saca/onboard/forecast/expected.h"

namespace saca::eval {

/// How the eight are compared.
struct OracleOptions {
  double time = 0.0;  ///< when they begin [s]
  int draws = 0;      ///< of what is left to chance, two at least; 0: the scenario as written
  std::uint64_t seed = 1;
  int threads = 1;             ///< they do not change the result
  bool only_defaults = false;  ///< one plan a policy, manoeuvre::default_plan, as the paper has it
};

/// What one policy ends in, by the plan `written.facts.plan`.
struct Verdict {
  encounter::Hindsight written;    ///< with nothing left to chance
  forecast::MeanOutcome expected;  ///< over the draws; without draws that of `written` alone
  forecast::Mean behind;           ///< harm above that of the best, draw by draw [-]
};

/// All eight, each with the plan of its own that is best (all target speeds, all strengths), and
/// their order.
struct Oracle {
  world::Scene scene;  ///< when they begin
  std::array<Verdict, manoeuvre::num_policies> verdicts;
  /// Those that can be driven, best first, by the one ordering (collision/ordering.h) of their
  /// expected outcomes.
  std::vector<manoeuvre::PolicyId> ranking;

  [[nodiscard]] manoeuvre::PolicyId best() const { return ranking.front(); }
  [[nodiscard]] const Verdict& of(manoeuvre::PolicyId policy) const {
    return verdicts[manoeuvre::index(policy)];
  }
};

/// Knows what the others will do, tries every plan that can be chosen (forecast::all_plans), and
/// ranks the policies by the plan of each whose expected harm is least; of those in one class
/// (collision::harm_class) the first, which is the default (manoeuvre::default_plan).
///
/// Common random numbers: draw k is the same world for every policy. Refusals are those of the
/// scene as written.
[[nodiscard]] Oracle oracle(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                            const collision::HarmModel& harm, const OracleOptions& options);

/// By how much the best is alone: the harm of the second best of all others above its own, and the
/// lower end of its 95 % interval. 0 or less: it is not alone.
struct Margin {
  double mean = 0.0;
  double low = 0.0;
};
[[nodiscard]] Margin margin_of_best(const Oracle& oracle);

}  // namespace saca::eval
