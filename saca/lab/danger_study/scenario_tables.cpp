#include "saca/lab/danger_study/scenario_tables.h"

#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/installation/shipped_files.h"

namespace saca::danger_study {

Result<ScenarioTables> tables_of(const installation::Installation& here,
                                 const std::vector<std::string>& scenarios) {
  std::vector<std::string> names = scenarios;
  if (names.empty()) {
    for (const std::filesystem::path& file : installation::shipped_scenarios(here)) {
      names.push_back(file.string());
    }
  }
  ScenarioTables tables;
  for (const std::string& scenario : names) {
    const auto read = installation::read_scenario_inputs(here, scenario);
    if (!read.has_value()) {
      return read.error();
    }
    const installation::ScenarioInputs& inputs = read.value();
    tables.stores.try_emplace(inputs.car_name, danger_sources(here, inputs).tables);
    if (const auto problem = tables.needed.add({inputs.car_name, inputs.car}, inputs.scenario)) {
      return *problem;
    }
  }
  return tables;
}

}  // namespace saca::danger_study
