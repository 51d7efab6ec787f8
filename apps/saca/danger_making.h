#pragma once

#include <optional>

#include "apps/saca/inputs.h"
#include "saca/base/core/result.h"
#include "saca/lab/danger_study/danger_model.h"
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/thinking/danger/danger.h"

namespace saca::app {

/// Where the tables of the inputs' car are kept (`danger_place`); what happens there is said on the
/// error stream.
[[nodiscard]] reach_study::TableStore table_store(const Inputs& inputs);

/// Likewise with what was learnt of the car, models/danger/CAR.safetensors.
[[nodiscard]] danger_study::DangerSources danger_sources(const Inputs& inputs);

/// By what was learnt of the car, and nothing that must be waited for; where tables are wanted,
/// with all that the scenario's actors need (danger_study::usual_model).
[[nodiscard]] Result<std::optional<danger::DangerModel>> usual_danger(const ScenarioInputs& inputs,
                                                                      bool with_tables);

}  // namespace saca::app
