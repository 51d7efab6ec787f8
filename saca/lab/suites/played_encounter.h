#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/lab/suites/encounter_source.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/thinking/intent/model.h"

namespace saca::suites {

/// The car that perceives, and what it believes by. What it points to outlives what uses it.
struct Perceiver {
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  const intent::Model* intent = nullptr;
};

/// How encounters are played.
struct PlayOptions {
  std::uint64_t seed = 1;  ///< of all that is drawn
  bool exact = false;  ///< nothing is left to chance, and perception is as the scenarios have it
};

/// An encounter as forecasts are held against it: with the draws and the perception of a suite.
struct PlayedEncounter {
  std::string family;
  scenario::Scenario world;
  scenario::Chance chance;
  std::optional<scenario::Scenario> twin;  ///< the same without risk, where there is one

  /// Refers to this and to what the perceiver points to.
  [[nodiscard]] encounter::Stage stage(const Perceiver& perceiver) const;
  /// Likewise of the twin, which must be there.
  [[nodiscard]] encounter::Stage twin_stage(const Perceiver& perceiver) const;
};

/// @return  as `at`
[[nodiscard]] Result<PlayedEncounter> played_encounter(const EncounterAt& at,
                                                       const PlayOptions& options,
                                                       std::uint64_t number);

}  // namespace saca::suites
