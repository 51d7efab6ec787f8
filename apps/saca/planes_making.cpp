#include "apps/saca/planes_making.h"

#include <utility>

#include "apps/saca/atlas_making.h"
#include "saca/lab/encounter/learnt_case.h"

namespace saca::app {

Result<std::unique_ptr<const PlanesOfCar>> open_planes(Inputs inputs,
                                                       const reflex::Thresholds& thresholds) {
  const auto costs = read_costs(inputs.places);
  if (!costs.has_value()) {
    return costs.error();
  }
  atlas::Atlas atlas = usual_atlas(inputs);
  std::unique_ptr<PlanesOfCar> planes(new PlanesOfCar{
      .inputs = std::move(inputs), .atlas = std::move(atlas), .clock = {}, .setup = {}});
  planes->setup = {.forecast = {.car = &planes->inputs.car,
                                .harm = &planes->inputs.harm,
                                .atlas = &planes->atlas,
                                .cues = &planes->inputs.cues},
                   .thresholds = thresholds,
                   .costs = costs.value(),
                   .clock = &planes->clock};
  return std::unique_ptr<const PlanesOfCar>(std::move(planes));
}

Result<std::unique_ptr<const PlanesOfCar>> open_planes(const std::string& car,
                                                       const reflex::Thresholds& thresholds) {
  auto inputs = read_inputs(car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  return open_planes(std::move(inputs).value(), thresholds);
}

std::vector<memory::MadeWith> made_with(const PlanesOfCar& planes) {
  return encounter::made_with(planes.setup.forecast, planes.inputs.intent, planes.inputs.car_name);
}

}  // namespace saca::app
