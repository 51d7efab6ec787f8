#pragma once

#include <string>

#include "apps/saca/places.h"
#include "saca/intent/cue_law.h"
#include "saca/intent/model.h"
#include "saca/manoeuvre/car.h"
#include "saca/outcome/harm.h"
#include "saca/runtime/charged_model.h"
#include "saca/sim/family.h"
#include "saca/sim/scenario.h"
#include "saca/sim/splits.h"

namespace saca::app {

/// What commands that play scenarios read before they begin.
struct Inputs {
  Places places;
  std::string car_name;
  manoeuvre::Car car;
  outcome::HarmModel harm;
  intent::Model intent;
  intent::CueLaw cues;  ///< what cues of a scene stand for: data/cues.toml
};

/// @param car  its file, or the name of a shipped one
[[nodiscard]] Result<Inputs> read_inputs(const std::string& car);

/// What thinking costs in lockstep: data/thinking_costs.toml.
[[nodiscard]] Result<runtime::ThinkingCosts> read_costs(const Places& places);

struct ScenarioInputs : Inputs {
  sim::Scenario scenario;
};

/// @param scenario  its file, or the name of a shipped one; it names the car
[[nodiscard]] Result<ScenarioInputs> read_scenario_inputs(const std::string& scenario);

/// Names the bytes of a scenario's file: FNV-1a, 16 hexadecimal digits.
/// @param scenario  as above
[[nodiscard]] Result<std::string> scenario_digest(const Places& places,
                                                  const std::string& scenario);

/// One shipped family, or one of the user's own folder.
[[nodiscard]] Result<sim::Family> read_family(const Places& places, const std::string& name);
[[nodiscard]] Result<sim::Splits> read_splits(const Places& places);

}  // namespace saca::app
