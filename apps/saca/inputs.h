#pragma once

#include <string>

#include "apps/saca/places.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/runtime/charged_model.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/model.h"

namespace saca::app {

/// What commands that play scenarios read before they begin.
struct Inputs {
  Places places;
  std::string car_name;
  manoeuvre::Car car;
  collision::HarmModel harm;
  intent::Model intent;
  intent::CueLaw cues;  ///< what cues of a scene stand for: data/cues.toml
};

/// @param car  its file, or the name of a shipped one
[[nodiscard]] Result<Inputs> read_inputs(const std::string& car);

/// What thinking costs in lockstep: data/thinking_costs.toml.
[[nodiscard]] Result<runtime::ThinkingCosts> read_costs(const Places& places);

struct ScenarioInputs : Inputs {
  scenario::Scenario scenario;
};

/// @param scenario  its file, or the name of a shipped one; it names the car
[[nodiscard]] Result<ScenarioInputs> read_scenario_inputs(const std::string& scenario);

/// Names the bytes of a scenario's file: FNV-1a, 16 hexadecimal digits.
/// @param scenario  as above
[[nodiscard]] Result<std::string> scenario_digest(const Places& places,
                                                  const std::string& scenario);

/// One shipped family, or one of the user's own folder.
[[nodiscard]] Result<families::Family> read_family(const Places& places, const std::string& name);
[[nodiscard]] Result<families::Splits> read_splits(const Places& places);

}  // namespace saca::app
