#include "saca/lab/vehicle_study/car_planes.h"

#include <utility>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/vehicle_study/kept_atlas.h"

namespace saca::vehicle_study {

Result<std::shared_ptr<const PlanesOfCar>> open_planes(const installation::Installation& here,
                                                       installation::Inputs inputs,
                                                       const reflex::Thresholds& thresholds) {
  const auto costs = installation::read_costs(here);
  if (!costs.has_value()) {
    return costs.error();
  }
  atlas::Atlas atlas = usual_atlas(here, inputs);
  const std::shared_ptr<PlanesOfCar> planes(new PlanesOfCar{
      .inputs = std::move(inputs), .atlas = std::move(atlas), .clock = {}, .setup = {}});
  planes->setup = {.forecast = {.car = &planes->inputs.car,
                                .harm = &planes->inputs.harm,
                                .atlas = &planes->atlas,
                                .cues = &planes->inputs.cues},
                   .thresholds = thresholds,
                   .costs = costs.value(),
                   .clock = &planes->clock};
  return std::shared_ptr<const PlanesOfCar>(planes);
}

Result<std::shared_ptr<const PlanesOfCar>> open_planes(const installation::Installation& here,
                                                       const std::string& car,
                                                       const reflex::Thresholds& thresholds) {
  auto inputs = installation::read_inputs(here, car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  return open_planes(here, std::move(inputs).value(), thresholds);
}

std::vector<memory::MadeWith> made_with(const PlanesOfCar& planes) {
  return encounter::made_with(planes.setup.forecast, planes.inputs.intent, planes.inputs.car_name);
}

}  // namespace saca::vehicle_study
