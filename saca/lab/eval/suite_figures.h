#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/eval/suite.h"

namespace saca::eval {

/// A mean over encounters with its 95 % interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  int n = 0;
};

/// Does the interval of a difference exclude 0? Of a single encounter there is none.
[[nodiscard]] inline bool is_sure(const Estimate& difference) {
  return difference.n > 1 && (difference.low > 0.0 || difference.high < 0.0);
}

/// Harm above AEB's that counts as materially worse [-]: half a per cent of a severely injured
/// person.
constexpr double material = 0.005;

/// What verdicts expected at the decision, and what then happened to the same plans, carried out to
/// their end from T1 on: over the encounters that were decided by a verdict at T1.
struct ExpectedFigures {
  Estimate expected;          ///< harm of what was decided on
  Estimate happened;          ///< likewise, with full knowledge
  Estimate braking_expected;  ///< of full braking, in the same encounters
  Estimate braking_happened;
  Estimate knowingly_worse;  ///< share decided on although expected to harm more than full braking
                             ///< by more than `material`
  Estimate several;          ///< share of all that a verdict decided, before T1 too, in which more
                             ///< than one plan was admissible
};

/// What was done in the twins without risk.
struct TwinFigures {
  Estimate false_trigger_loss;  ///< the paper's
  Estimate false_triggers;      ///< share with an intervention
  Estimate harm;                ///< what acting without need does
};

/// Figures of one method over some encounters.
struct MethodFigures {
  std::string method;
  Estimate harm;
  Estimate regret;            ///< harm above that of the best of all plans begun at T1
  Estimate published_regret;  ///< likewise of the paper's eight policies, whose braking has one
                              ///< strength
  Estimate over_aeb;          ///< harm above that of AEB at T1 in the same encounters: paired
  Estimate collision_loss;    ///< the paper's
  Estimate contact;           ///< share
  Estimate right;             ///< share whose harm is in the class of the best's, or below
  Estimate worse_than_aeb;    ///< share whose harm is more than `material` above AEB's
  Estimate
      needless;  ///< share of encounters in which doing nothing harms nobody, where it intervened
  Estimate switches;                   ///< how often another plan was begun later, in an encounter
  std::optional<TwinFigures> twins;    ///< nullopt: no encounter has one
  std::map<std::string, int> sources;  ///< of decisions, how often
  std::map<std::string, int> reasons;  ///< likewise
  std::optional<encounter::ThinkingFigures> thinking;  ///< summed, without answers; nullopt: the
                                                       ///< method does not think ahead
  std::optional<ExpectedFigures> expected;             ///< nullopt: nothing was decided by verdicts
  int faults = 0;  ///< encounters in which, or in whose twin, it threw: nobody's figures count them
};

/// The paper's false-trigger loss: 0.5 for policies 0 to 4, 1 for 5 and 6, 0 for none.
[[nodiscard]] double false_trigger_loss(const MethodRun& run);

/// Figures of all methods over the rows in which nothing went wrong (counts_in_figures).
///
/// Intervals are those of 1,000 bootstrap samples of encounters (B. Efron, Bootstrap methods:
/// another look at the jackknife, Annals of Statistics 7, 1979), percentiles 2.5 and 97.5, the same
/// samples for every figure: what is paired stays paired.
/// @param rows  at least one
/// @param aeb   index of the method that others are held against; it is AEB at T1
[[nodiscard]] std::vector<MethodFigures> suite_figures(std::span<const SuiteRow* const> rows,
                                                       const std::vector<std::string>& methods,
                                                       std::optional<std::size_t> aeb,
                                                       std::uint64_t seed);

/// Mean of the harm of one method above that of another, over the same rows: paired, with the
/// intervals of suite_figures.
/// @param method, other  indices into the runs of a row
[[nodiscard]] Estimate harm_above(std::span<const SuiteRow> rows, std::size_t method,
                                  std::size_t other, std::uint64_t seed);

/// Of what an encounter counts for, with the intervals of suite_figures.
/// @param values  one for each encounter; nullopt: it does not count
[[nodiscard]] Estimate mean_over_encounters(const std::vector<std::optional<double>>& values,
                                            std::uint64_t seed);

}  // namespace saca::eval
