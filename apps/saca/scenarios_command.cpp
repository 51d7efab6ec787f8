#include "apps/saca/options.h"
#include "saca/lab/installation/shipped_files.h"

namespace saca::app {
namespace {

struct ScenariosOptions {
  bool as_json = false;
};

ExitCode list_scenarios(const ScenariosOptions& options) {
  nlohmann::json list = nlohmann::json::array();
  std::string text;
  ExitCode code = success;
  for (const fs::path& file : installation::shipped_scenarios(here())) {
    const auto read = scenario::load_scenario(file);
    if (!read.has_value()) {
      complain(read.error().message);
      code = bad_input;
      continue;
    }
    const scenario::Scenario& one = read.value();
    list.push_back({{"name", one.name}, {"title", one.title}, {"source", one.source}});
    text += fmt::format("{:28} {}\n", one.name, one.title);
  }
  tell(options.as_json, list, text);
  return code;
}

}  // namespace

void add_scenarios(CLI::App& line) {
  const auto [command, options] = add_command<ScenariosOptions>(
      line, "scenarios", "List the shipped scenarios", list_scenarios);
  add_json(command, options.as_json);
}

}  // namespace saca::app
