#include "apps/saca/danger_making.h"

#include <string>

#include "apps/saca/places.h"
#include "apps/saca/settings.h"

namespace saca::app {

reach_study::TableStore table_store(const Inputs& inputs) {
  return {.place = [places = inputs.places, car = inputs.car_name](
                       const std::string& table) { return danger_place(places, car, table); },
          .notice = complain,
          .display = progress_display()};
}

danger_study::DangerSources danger_sources(const Inputs& inputs) {
  return {.car = {inputs.car_name, inputs.car},
          .weights = inputs.places.root / "models" / "danger" / (inputs.car_name + ".safetensors"),
          .tables = table_store(inputs)};
}

Result<std::optional<danger::DangerModel>> usual_danger(const ScenarioInputs& inputs,
                                                        bool with_tables) {
  using danger_study::TableUse;
  return danger_study::usual_model(danger_sources(inputs), inputs.scenario,
                                   with_tables ? TableUse::solved : TableUse::none);
}

}  // namespace saca::app
