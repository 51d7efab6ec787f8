#include "saca/lab/reach_study/needed_tables.h"

#include <fmt/core.h>

#include "saca/lab/reach_study/scenario_obstacles.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::reach_study {

Result<std::vector<danger::DangerCase>> tables_for(const prepare::NamedCar& car,
                                                   const scenario::Scenario& scenario) {
  return tables_for(car, scenario::believed_grip(scenario),
                    obstacles_of(scenario, manoeuvre::footprint(car.car)));
}

std::optional<Error> NeededTables::add(const prepare::NamedCar& car,
                                       const scenario::Scenario& scenario) {
  const auto needed = tables_for(car, scenario);
  if (!needed.has_value()) {
    return needed.error();
  }
  Tables& tables = cars_[car.name];
  for (const danger::DangerCase& table : needed.value()) {
    tables.try_emplace(table.name, table);
  }
  return std::nullopt;
}

std::string table_line(const std::string& car, const std::string& table, const ReadyTable& ready) {
  return fmt::format("{:18} {:20} {}\n", car, table, ready.was_there ? "was there" : "solved");
}

nlohmann::json table_json(const std::string& car, const std::string& table,
                          const ReadyTable& ready) {
  return {{"car", car},
          {"table", table},
          {"file", ready.file.string()},
          {"was_there", ready.was_there}};
}

}  // namespace saca::reach_study
