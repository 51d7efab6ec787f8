#include "apps/saca/options.h"
#include "saca/lab/family_samples/family_request.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct FamilyOptions : family_samples::FamilyRequest {
  std::string svg = "runs/family.svg";
  std::string write;  ///< folder for scenarios; empty: none are written
  bool as_json = false;
};

void draw_family(const FamilyOptions& options) {
  const fs::path folder = options.write;
  need_distinct({{"--svg", options.svg}}, {{"the family", options.name}});
  need_writable({options.svg, folder.empty() ? fs::path() : folder / "x.toml"});
  const auto drawn = need(family_samples::drawn_family(here(), options));
  json list = json::array();
  for (const scenario::Scenario& scenario : drawn.scenarios) {
    const fs::path file = folder.empty() ? fs::path() : folder / (scenario.name + ".toml");
    if (!file.empty()) {
      app::write(file, scenario::write_scenario(scenario));
    }
    list.push_back(family_samples::json_of(scenario, file));
  }
  app::write(options.svg, report::contact_sheet(drawn.sheet));
  tell(options.as_json,
       json{{"schema", "saca.family_samples/1"},
            {"family", drawn.name},
            {"split", options.split},
            {"seed", drawn.seed},
            {"svg", options.svg},
            {"samples", std::move(list)}},
       fmt::format("{} samples of {}: {}\n", options.count, drawn.name,
                   fs::absolute(options.svg).string()));
}

}  // namespace

void add_family(CLI::App& line) {
  const auto [command, options] = add_command<FamilyOptions>(
      line, "family", "Draw encounters of a family, as a sheet of pictures", draw_family);
  add_needed(command, "name", options.name, "A shipped family, or a file of your own (*.toml)");
  add(command, "--sample", options.count, "How many", CLI::Range(1, 400));
  add(command, "--first", options.first, "Number of the first", CLI::Range(0, 1'000'000'000));
  add_split(command, options.split, options.test_log);
  add(command, "--cues", options.cues, "With the cues of this suite");
  command.add_flag("--twins", options.twins, "The same encounters without risk");
  add_car(command, options.car);
  add(command, "--svg", options.svg, "The sheet");
  add(command, "--write", options.write, "Folder: write them there as scenario files");
  add_json(command, options.as_json);
}

}  // namespace saca::app
