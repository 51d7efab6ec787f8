#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/comparison.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/scenario/perception_model.h"

namespace saca::eval {

/// One encounter of a suite.
struct SuiteEncounter {
  std::uint64_t number = 0;
  std::string family;
  scenario::Scenario scenario;
  std::optional<scenario::Scenario> twin;  ///< the same without risk
};

/// What the ego of an automated car perceives in a suite, unless a scenario says it itself: a
/// tracker of radar and camera as production cars have it. All numbers are assumptions of that
/// order; none comes from one sensor's data sheet.
[[nodiscard]] scenario::PerceptionModel usual_perception();

/// How a suite is run.
struct SuiteOptions {
  std::vector<std::string> methods;                  ///< names of eval::methods(), at least one
  std::uint64_t seed = 1;                            ///< of all that is drawn
  const learned_danger::Network* danger = nullptr;   ///< as in MethodTools
  const memory::Experience* experience = nullptr;    ///< likewise
  const Imitators* imitators = nullptr;              ///< likewise
  language_model::LanguageModel* untuned = nullptr;  ///< likewise
  bool exact = false;  ///< nothing is left to chance and perception is as the scenarios have it
};

/// What is left to chance in encounter `number`.
[[nodiscard]] scenario::Chance chance_of(const SuiteOptions& options, std::uint64_t number);

/// What the recorded driver did in an encounter that was recorded, from T2 on.
struct DriverRow {
  double harm = 0.0;
  std::optional<std::string> met;  ///< with whom or what the first contact was
  double impact_speed = 0.0;       ///< relative, of that contact [m/s]
  bool brakes = false;             ///< see encounter/recorded_driver.h
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

/// What went wrong in an encounter or its twin, in words: why it could not be played, or which
/// method threw what. nullopt: nothing did.
/// @param methods  names, in the order of the row's runs
[[nodiscard]] std::optional<std::string> failure_of(const SuiteRow& row,
                                                    const std::vector<std::string>& methods);
/// Whether it counts in figures: nothing went wrong. What a method did that threw says nothing, and
/// without it others would be held against other encounters.
[[nodiscard]] bool counts_in_figures(const SuiteRow& row);

/// Seed of what is left to chance in one encounter: `saca run FILE --seed` of it plays the same
/// world.
[[nodiscard]] std::uint64_t encounter_seed(std::uint64_t seed, std::uint64_t number);

/// The scenario as the suite plays it: with the usual perception, where it says nothing of it but
/// what the grip is taken for.
[[nodiscard]] scenario::Scenario as_played(scenario::Scenario scenario,
                                           const SuiteOptions& options);

/// What plays an encounter, with its draws.
/// @param world  as it is played (as_played); outlives the stage
[[nodiscard]] encounter::Stage stage_of(const scenario::Scenario& world, std::uint64_t number,
                                        const SuiteOptions& options,
                                        const runtime::PlanesSetup& saca,
                                        const intent::Model& intent);

/// Runs one encounter. One does not depend on the others.
/// @param saca  of SACA and everybody's forecasts
[[nodiscard]] SuiteRow run_encounter(const SuiteEncounter& encounter, const SuiteOptions& options,
                                     const runtime::PlanesSetup& saca, const intent::Model& intent);

/// What every plan leads to from T1 on, if nobody acts before: for pictures.
struct TriedScene {
  world::Scene scene;                     ///< the truth at T1, everybody who is there then or later
  std::vector<preview::RolledOut> tried;  ///< in the order of forecast::all_plans
};
/// @return  nullopt: T1 never comes, or the encounter cannot be played
[[nodiscard]] std::optional<TriedScene> tried_in(const SuiteEncounter& encounter,
                                                 const SuiteOptions& options,
                                                 const runtime::PlanesSetup& saca,
                                                 const intent::Model& intent);

/// As JSON, for journals; and back. Error::Code::malformed: no such row, or of other methods.
[[nodiscard]] nlohmann::json to_json(const SuiteRow& row);
[[nodiscard]] Result<SuiteRow> suite_row_from_json(const nlohmann::json& in,
                                                   std::size_t num_methods);
/// Likewise as one line.
[[nodiscard]] std::string line_of(const SuiteRow& row);
[[nodiscard]] Result<SuiteRow> suite_row_from(std::string_view line, std::size_t num_methods);

}  // namespace saca::eval
