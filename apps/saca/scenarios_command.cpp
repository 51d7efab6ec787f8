#include <memory>
#include <nlohmann/json.hpp>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

int list_scenarios(bool as_json) {
  const auto places = find_places();
  if (!places.has_value()) {
    complain(places.error().message);
    return bad_input;
  }
  nlohmann::json list = nlohmann::json::array();
  int code = success;
  for (const fs::path& file : shipped_scenarios(places.value())) {
    const auto scenario = scenario::load_scenario(file);
    if (!scenario.has_value()) {
      complain(scenario.error().message);
      code = bad_input;
      continue;
    }
    list.push_back({{"name", scenario.value().name},
                    {"title", scenario.value().title},
                    {"source", scenario.value().source}});
    if (!as_json) {
      app::print("{:28} {}\n", scenario.value().name, scenario.value().title);
    }
  }
  if (as_json) {
    app::print_json(list);
  }
  return code;
}

}  // namespace

void add_scenarios(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("scenarios", "List the shipped scenarios");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "For programs");
  command->callback([as_json, &exit_code] { exit_code = list_scenarios(*as_json); });
}

}  // namespace saca::app
