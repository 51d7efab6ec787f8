#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/moment_option.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/whatif_cells.h"
#include "saca/lab/policy_study/whatif_picture.h"
#include "saca/lab/policy_study/whatif_report.h"

namespace saca::app {
namespace {

struct WhatifCommand {
  std::string scenario;
  std::vector<std::string> vary;
  std::optional<double> at;
  std::string svg = "runs/whatif.svg";
  int threads = usual_threads();
  bool as_json = false;
};

/// Fills the cells of a map and leaves its picture.
int try_and_tell(const WhatifCommand& options, const collision::HarmModel& harm,
                 policy_study::WhatifMap& map) {
  auto cells = policy_study::try_cells(map, harm, {options.threads, progress_display()});
  if (!cells.has_value()) {
    return refused(cells.error());
  }
  if (!cells.value()) {
    complain("interrupted; nothing was written");
    return was_interrupted;
  }
  map.cells = *std::move(cells).value();
  if (const auto problem = long_work::write_output(options.svg, policy_study::whatif_svg(map))) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(policy_study::json_of(map));
  } else {
    app::print("{}Map: {}\n", policy_study::text_of(map),
               std::filesystem::absolute(options.svg).string());
  }
  return success;
}

int run(const WhatifCommand& options) {
  const auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  auto axes = policy_study::axes_of(options.vary, inputs.value().scenario);
  if (!axes.has_value()) {
    return refused(axes.error());
  }
  const auto time = decision_time(inputs.value(), options.at);
  if (!time.has_value()) {
    return refused(time.error());
  }
  if (!time.value()) {
    return nothing_to_decide;
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  policy_study::WhatifMap map{.scenario = &inputs.value().scenario,
                              .car = &inputs.value().car,
                              .time = *time.value(),
                              .axes = std::move(axes).value(),
                              .cells = {}};
  return try_and_tell(options, inputs.value().harm, map);
}

}  // namespace

void add_whatif(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "whatif", "Map which policy is best when one or two numbers of a scenario change");
  const auto options = std::make_shared<WhatifCommand>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  command
      ->add_option("--vary", options->vary,
                   "NUMBER=FROM:TO:STEP, once or twice. As it is when the policies begin: "
                   "ego.speed_mps, ego.offset_m, truck1.distance_m, truck1.offset_m, "
                   "truck1.speed_mps, grip; as it stands in the scenario: any other number, by its "
                   "keys and places in lists, as road.left_edge_m, truck1.start.brake_at_s, "
                   "actors.0.mass_kg")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_size(1);
  add_at(*command, options->at);
  command->add_option("--svg", options->svg, "The map")->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] {
    if (options->vary.size() > 2) {
      throw CLI::ValidationError("--vary", "at most twice");
    }
    exit_code = run(*options);
  });
}

}  // namespace saca::app
