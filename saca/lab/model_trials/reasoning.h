#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/lab/installation/inputs.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::model_trials {

/// A model, and what it would first be asked in an encounter. It stays where it is: `tools` points
/// to the rest.
struct Reasoning {
  installation::ScenarioInputs inputs;
  std::unique_ptr<language_model::LanguageModel> model;
  atlas::Atlas atlas;
  std::optional<danger::DangerModel> danger;
  preview::ForecastTools tools;
  std::vector<arbitration::Preview> asked;  ///< none: nothing ever threatens
};

/// @param scenario  its file, or the name of a shipped one
/// @param model     as model_access::open_needed_model takes it
/// @param clock     outlives what is returned
[[nodiscard]] Result<std::unique_ptr<const Reasoning>> open_reasoning(
    const installation::Installation& here, const std::string& scenario, const std::string& model,
    Clock& clock);

}  // namespace saca::model_trials
