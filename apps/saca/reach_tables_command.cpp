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
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/lab/reach_study/needed_tables.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct TablesOptions {
  std::vector<std::string> scenarios;
  bool as_json = false;
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

/// What the scenarios need, and of each car's tables where they are kept.
struct Needed {
  reach_study::NeededTables tables;
  std::map<std::string, reach_study::TableStore> stores;
};

Result<Needed> needed_by(const std::vector<std::string>& scenarios) {
  Needed needed;
  for (const std::string& scenario : scenarios) {
    const auto read = read_scenario_inputs(scenario);
    if (!read.has_value()) {
      return read.error();
    }
    const ScenarioInputs& inputs = read.value();
    needed.stores.try_emplace(inputs.car_name, table_store(inputs));
    if (auto problem = needed.tables.add({inputs.car_name, inputs.car}, inputs.scenario)) {
      return *std::move(problem);
    }
  }
  return needed;
}

int make_tables(TablesOptions options) {
  if (options.scenarios.empty()) {
    auto shipped = all_shipped();
    if (!shipped.has_value()) {
      return refused(shipped.error());
    }
    options.scenarios = std::move(shipped).value();
  }
  const auto needed = needed_by(options.scenarios);
  if (!needed.has_value()) {
    return refused(needed.error());
  }
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [car, tables] : needed.value().tables.by_car()) {
    for (const auto& [name, table] : tables) {
      const auto ready = reach_study::ready_table(table, needed.value().stores.at(car));
      if (!ready.has_value()) {
        return refused(ready.error());
      }
      if (ready.value().not_kept) {
        return refused(*ready.value().not_kept);
      }
      list.push_back(reach_study::table_json(car, name, ready.value()));
      if (!options.as_json) {
        app::print("{}", reach_study::table_line(car, name, ready.value()));
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
