#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct TablesOptions {
  std::vector<std::string> scenarios;
  bool as_json = false;
};

struct NeededByCar {
  Inputs inputs;
  std::map<std::string, danger::DangerCase> tables;  // by their names
};

Result<std::vector<std::string>> all_shipped() {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  std::vector<std::string> files;
  for (const fs::path& file : shipped_scenarios(places.value())) {
    files.push_back(file.string());
  }
  return files;
}

/// By the cars' names.
Result<std::map<std::string, NeededByCar>> needed_by(const std::vector<std::string>& scenarios) {
  std::map<std::string, NeededByCar> cars;
  for (const std::string& scenario : scenarios) {
    const auto inputs = read_scenario_inputs(scenario);
    if (!inputs.has_value()) {
      return inputs.error();
    }
    auto& car =
        cars.try_emplace(inputs.value().car_name, NeededByCar{inputs.value(), {}}).first->second;
    const auto needed = needed_tables(inputs.value());
    if (!needed.has_value()) {
      return needed.error();
    }
    for (const danger::DangerCase& table : needed.value()) {
      car.tables.try_emplace(table.name, table);
    }
  }
  return cars;
}

int make_tables(TablesOptions options) {
  if (options.scenarios.empty()) {
    auto shipped = all_shipped();
    if (!shipped.has_value()) {
      return refused(shipped.error());
    }
    options.scenarios = std::move(shipped).value();
  }
  const auto cars = needed_by(options.scenarios);
  if (!cars.has_value()) {
    return refused(cars.error());
  }
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [car, needed] : cars.value()) {
    for (const auto& [name, table] : needed.tables) {
      const auto ready = ready_table(needed.inputs, table);
      if (!ready.has_value()) {
        return refused(ready.error());
      }
      if (ready.value().not_kept) {
        return refused(*ready.value().not_kept);
      }
      const std::string file = ready.value().file.string();
      list.push_back(
          {{"car", car}, {"table", name}, {"file", file}, {"was_there", ready.value().was_there}});
      if (!options.as_json) {
        app::print("{:18} {:20} {}\n", car, name, ready.value().was_there ? "was there" : "solved");
      }
    }
  }
  if (options.as_json) {
    app::print_json(list);
  }
  return success;
}

}  // namespace

void add_reach_tables(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "tables", "Make the tables of danger that scenarios need, so that no run waits for them");
  const auto options = std::make_shared<TablesOptions>();
  command->add_option("scenarios", options->scenarios,
                      "Files, or names of shipped ones (default: all that are shipped)");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = make_tables(*options); });
}

}  // namespace saca::app
