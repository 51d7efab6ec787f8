#pragma once

#include <optional>
#include <string>

#include "saca/lab/danger_study/danger_model.h"
#include "saca/lab/danger_study/weights.h"
#include "saca/lab/installation/inputs.h"

namespace saca::danger_study {

/// Where what is known of the car's danger is kept: its tables (installation::kept_place), and what
/// was learnt of it, models/danger/CAR.safetensors. What happens there is noticed.
[[nodiscard]] DangerSources danger_sources(const installation::Installation& here,
                                           const installation::Inputs& inputs);

/// usual_model from there.
[[nodiscard]] Result<std::optional<danger::DangerModel>> usual_danger(
    const installation::Installation& here, const installation::ScenarioInputs& inputs,
    TableUse tables = TableUse::none);

/// What a file of weights says, and the car that it is of.
struct DangerWeights : Weights {
  installation::Inputs inputs;
};
/// @return  an error naming file, tensor or word, wanted and got
[[nodiscard]] Result<DangerWeights> read_danger_weights(const installation::Installation& here,
                                                        const std::string& path);

}  // namespace saca::danger_study
