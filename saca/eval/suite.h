#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/core/result.h"
#include "saca/eval/comparison.h"
#include "saca/eval/methods.h"
#include "saca/sim/perception_model.h"

namespace saca::eval {

/// One encounter of a suite.
struct SuiteEncounter {
  std::uint64_t number = 0;
  std::string family;
  sim::Scenario scenario;
  std::optional<sim::Scenario> twin;  ///< the same without risk
};

/// What the ego of an automated car perceives in a suite, unless a scenario says it itself: a
/// tracker of radar and camera as production cars have it. All numbers are assumptions of that
/// order; none comes from one sensor's data sheet.
[[nodiscard]] sim::PerceptionModel usual_perception();

/// How a suite is run.
struct SuiteOptions {
  std::vector<std::string> methods;  ///< names of eval::methods(), at least one
  std::uint64_t seed = 1;            ///< of all that is drawn
  bool exact = false;  ///< nothing is left to chance and perception is as the scenarios have it
};

/// What the recorded driver did in an encounter that was recorded, from T2 on.
struct DriverRow {
  double harm = 0.0;
  std::optional<std::string> met;  ///< with whom or what the first contact was
  double impact_speed = 0.0;       ///< relative, of that contact [m/s]
  bool brakes = false;             ///< see loop/recorded_driver.h
  int steers = 0;                  ///< likewise
};

/// Does a plan do what the driver did: brake, and to which side?
[[nodiscard]] bool agrees(const DriverRow& driver, const std::optional<manoeuvre::Plan>& plan);

/// One encounter, run with every method, and its twin.
struct SuiteRow {
  std::uint64_t number = 0;
  std::string family;
  std::string fault;  ///< why it could not be played; empty: it could, and the rest has meaning
  Comparison risk;
  std::optional<Comparison> twin;
  std::optional<DriverRow> driver;  ///< where the ego was recorded
};

/// Seed of what is left to chance in one encounter: `saca run FILE --seed` of it plays the same
/// world.
[[nodiscard]] std::uint64_t encounter_seed(std::uint64_t seed, std::uint64_t number);

/// The scenario as the suite plays it: with the usual perception, where it says nothing of it.
[[nodiscard]] sim::Scenario as_played(sim::Scenario scenario, const SuiteOptions& options);

/// Runs one encounter. One does not depend on the others.
/// @param saca  of SACA and everybody's forecasts
[[nodiscard]] SuiteRow run_encounter(const SuiteEncounter& encounter, const SuiteOptions& options,
                                     const loop::PlanesSetup& saca, const intent::Model& intent);

/// What every plan leads to from T1 on, if nobody acts before: for pictures.
struct TriedScene {
  world::Scene scene;                     ///< the truth at T1, everybody who is there then or later
  std::vector<preview::RolledOut> tried;  ///< in the order of preview::all_plans
};
/// @return  nullopt: T1 never comes, or the encounter cannot be played
[[nodiscard]] std::optional<TriedScene> tried_in(const SuiteEncounter& encounter,
                                                 const SuiteOptions& options,
                                                 const loop::PlanesSetup& saca,
                                                 const intent::Model& intent);

/// One line, for journals; and back. Error::Code::malformed: no such line, or of other methods.
[[nodiscard]] std::string line_of(const SuiteRow& row);
[[nodiscard]] Result<SuiteRow> suite_row_from(std::string_view line, std::size_t num_methods);

/// A mean over encounters with its 95 % interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  int n = 0;
};

/// Figures of one method over some encounters.
struct MethodFigures {
  std::string method;
  Estimate harm;
  Estimate regret;          ///< harm above that of the best plan begun at T1
  Estimate over_aeb;        ///< harm above that of AEB at T1 in the same encounters: paired
  Estimate collision_loss;  ///< the paper's
  Estimate contact;         ///< share
  Estimate right;           ///< share whose harm is in the class of the best's, or below
  Estimate worse_than_aeb;  ///< share whose harm is more than `material` above AEB's
  Estimate
      needless;  ///< share of encounters in which doing nothing harms nobody, where it intervened
  std::optional<Estimate> false_trigger_loss;  ///< the paper's, over the twins
  std::optional<Estimate> false_triggers;      ///< share of the twins with an intervention
  std::map<std::string, int> sources;          ///< of decisions, how often
  std::map<std::string, int> reasons;          ///< likewise
  int faults = 0;
};

/// Harm above AEB's that counts as materially worse [-]: half a per cent of a severely injured
/// person.
constexpr double material = 0.005;

/// The paper's false-trigger loss: 0.5 for policies 0 to 4, 1 for 5 and 6, 0 for none.
[[nodiscard]] double false_trigger_loss(const MethodRun& run);

/// Figures of all methods over the rows that have no fault.
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

/// Mean of the harm of one method above that of another, over the rows that have no fault: paired,
/// with the intervals of suite_figures.
/// @param method, other  indices into the runs of a row
[[nodiscard]] Estimate harm_above(std::span<const SuiteRow> rows, std::size_t method,
                                  std::size_t other, std::uint64_t seed);

}  // namespace saca::eval
