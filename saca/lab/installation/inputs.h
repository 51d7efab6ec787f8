#pragma once

#include <string>

#include "saca/lab/installation/installation.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/runtime/charged_model.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/model.h"

namespace saca::installation {

/// What scenarios are played with.
struct Inputs {
  std::string car_name;
  manoeuvre::Car car;
  collision::HarmModel harm;
  intent::Model intent;
  intent::CueLaw cues;  ///< what cues of a scene stand for: data/cues.toml
};

struct ScenarioInputs : Inputs {
  scenario::Scenario scenario;
};

/// @param car  its file, or the name of a shipped one
/// @return  its name is that of the file
[[nodiscard]] Result<prepare::NamedCar> read_named_car(const Installation& here,
                                                       const std::string& car);

[[nodiscard]] Result<collision::HarmModel> read_harm(const Installation& here);

/// @param car  its file, or the name of a shipped one
[[nodiscard]] Result<Inputs> read_inputs(const Installation& here, const std::string& car);

/// @param scenario  its file, or the name of a shipped one; it names the car
[[nodiscard]] Result<ScenarioInputs> read_scenario_inputs(const Installation& here,
                                                          const std::string& scenario);

/// What thinking costs in lockstep: data/thinking_costs.toml.
[[nodiscard]] Result<runtime::ThinkingCosts> read_costs(const Installation& here);

}  // namespace saca::installation
