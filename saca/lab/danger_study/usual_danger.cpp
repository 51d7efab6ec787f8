#include "saca/lab/danger_study/usual_danger.h"

#include <utility>

namespace saca::danger_study {

using installation::Inputs;
using installation::Installation;

DangerSources danger_sources(const Installation& here, const Inputs& inputs) {
  const auto place = [here, car = inputs.car_name](const std::string& table) {
    return installation::kept_place(here, std::filesystem::path("reach") / car / (table + ".h5"));
  };
  return {.car = {inputs.car_name, inputs.car},
          .weights = here.root / "models" / "danger" / (inputs.car_name + ".safetensors"),
          .tables = {.place = place, .notice = here.notice, .display = here.display}};
}

Result<std::optional<danger::DangerModel>> usual_danger(const Installation& here,
                                                        const installation::ScenarioInputs& inputs,
                                                        TableUse tables) {
  return usual_model(danger_sources(here, inputs), inputs.scenario, tables);
}

Result<DangerWeights> read_danger_weights(const Installation& here, const std::string& path) {
  auto weights = read_weights(path);
  if (!weights.has_value()) {
    return weights.error();
  }
  auto inputs = installation::read_inputs(here, weights.value().car_name);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  if (auto other = why_of_another_car(weights.value(), inputs.value().car, path)) {
    return *std::move(other);
  }
  return DangerWeights{std::move(weights).value(), std::move(inputs).value()};
}

}  // namespace saca::danger_study
