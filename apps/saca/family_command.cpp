#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/policy_sheet.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FamilyCommand {
  std::string name;
  std::string car = "compact_rwd_ev";
  int count = 12;
  int first = 0;
  std::string split = "tuning";
  std::string test_log;
  std::string svg = "runs/family.svg";
  std::string write;
  std::string cues;  ///< a suite whose cues they have; empty: they have none
  bool twins = false;
  bool as_json = false;
};

/// A sample with what comes of doing nothing from the trigger on.
report::SceneView thumbnail(const scenario::Scenario& scenario,
                            const std::vector<families::DrawnCue>& cues, const Inputs& inputs) {
  const auto trigger = eval::trigger_time(scenario, inputs.car);
  const eval::DecisionPoint point =
      eval::decision_point_at(scenario, inputs.car, trigger.value_or(0.0));
  const auto tried = encounter::hindsight(point, inputs.car, inputs.harm);
  report::SceneView view = policy_study::view_of(
      point.scene, tried[manoeuvre::index(manoeuvre::PolicyId::no_intervention)]);
  view.policy = std::nullopt;
  view.title = scenario.name;
  view.lines.insert(view.lines.begin(),
                    fmt::format("{:.1f} m/s, grip {:.2f}{}", norm(point.scene.ego.v_B),
                                scenario.grip, trigger ? "" : "; never triggers"));
  for (std::size_t k = 0; k < cues.size(); ++k) {
    const Vec2 p_W = scenario.cues[k].p_W;
    view.lines.insert(view.lines.begin() + 1,
                      fmt::format("{} at {:.0f}, {:.1f} m{}", name(cues[k].kind), p_W.x, p_W.y,
                                  cues[k].comes ? ", and it comes" : ""));
  }
  return view;
}

json json_of(const scenario::Scenario& scenario, const fs::path& file) {
  return {{"name", scenario.name},
          {"file", file.empty() ? json() : json(file.string())},
          {"grip", scenario.grip},
          {"ego_speed_mps", std::get<scenario::EgoStart>(scenario.ego).speed},
          {"actors", scenario.actors.size()}};
}

std::optional<Error> write_picture(const FamilyCommand& options,
                                   const report::ContactSheet& sheet) {
  return long_work::write_output(options.svg, report::contact_sheet(sheet));
}

int run(const FamilyCommand& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  auto read = read_family(inputs.value().places, options.name);
  const auto splits = read_splits(inputs.value().places);
  const fs::path some_file =
      options.write.empty() ? fs::path() : fs::path(options.write) / "x.toml";
  if (const auto problem = long_work::why_outputs_unwritable({options.svg, some_file})) {
    return refused(*problem);
  }
  if (!read.has_value() || !splits.has_value()) {
    return refused(read.has_value() ? splits.error() : read.error());
  }
  families::Family family = std::move(read).value();
  if (!options.cues.empty()) {
    const auto cues =
        eval::cues_of_suite(inputs.value().places.root / "scenarios" / "families", options.cues);
    if (!cues.has_value()) {
      return refused({cues.error().code, "--cues: " + cues.error().message});
    }
    family.cues = cues.value();
  }
  std::optional<families::TestLog> log;
  if (!options.test_log.empty()) {
    log = families::TestLog{options.test_log,
                            fmt::format("saca family {} --first {} --sample {}", options.name,
                                        options.first, options.count)};
  }
  const auto seed =
      families::seed_for(splits.value(), *families::split_from(options.split), family.name, log);
  if (!seed.has_value()) {
    const std::string hint = options.split == "test" ? " (--test-log FILE)" : "";
    return refused({seed.error().code, seed.error().message + hint});
  }
  report::ContactSheet sheet;
  sheet.heading = fmt::format("{}: {}", family.name, family.title);
  sheet.lines = {family.why, "Drawn: nobody intervenes."};
  json list = json::array();
  const world::Footprint ego = manoeuvre::footprint(inputs.value().car);
  for (int k = options.first; k < options.first + options.count; ++k) {
    const auto sample = families::sample(family, seed.value(), static_cast<std::uint64_t>(k),
                                         inputs.value().car_name, ego);
    if (!sample.has_value()) {
      return refused(sample.error());
    }
    const scenario::Scenario& scenario =
        options.twins ? sample.value().twin : sample.value().scenario;
    fs::path file;
    if (!options.write.empty()) {
      file = fs::path(options.write) / (scenario.name + ".toml");
      auto problem = long_work::write_output(file, scenario::write_scenario(scenario));
      if (problem) {
        return refused(*problem);
      }
    }
    list.push_back(json_of(scenario, file));
    std::vector<families::DrawnCue> cues = sample.value().cues;
    for (families::DrawnCue& cue : cues) {
      cue.comes = cue.comes && !options.twins;
    }
    sheet.scenes.push_back(thumbnail(scenario, cues, inputs.value()));
  }
  if (const auto problem = write_picture(options, sheet)) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(json{{"schema", "saca.family_samples/1"},
                         {"family", family.name},
                         {"split", options.split},
                         {"seed", seed.value()},
                         {"svg", options.svg},
                         {"samples", list}});
  } else {
    app::print("{} samples of {}: {}\n", options.count, family.name,
               fs::absolute(options.svg).string());
  }
  return success;
}

}  // namespace

void add_family(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("family", "Draw encounters of a family, as a sheet of pictures");
  const auto options = std::make_shared<FamilyCommand>();
  command->add_option("name", options->name, "A shipped family, or a file of your own (*.toml)")
      ->required();
  command->add_option("--sample", options->count, "How many")
      ->check(CLI::Range(1, 400))
      ->capture_default_str();
  command->add_option("--first", options->first, "Number of the first")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  command->add_option("--split", options->split, "Whose seed is used")
      ->check(one_of({"tuning", "calibration", "test"}))
      ->capture_default_str();
  command->add_option("--test-log", options->test_log,
                      "Where a use of the test split is noted; needed for it");
  command->add_option("--cues", options->cues, "With the cues of this suite");
  command->add_flag("--twins", options->twins, "The same encounters without risk");
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("--svg", options->svg, "The sheet")->capture_default_str();
  command->add_option("--write", options->write, "Folder: write them there as scenario files");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
