#include "apps/saca/options.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/policy_study/whatif_cells.h"
#include "saca/lab/policy_study/whatif_picture.h"
#include "saca/lab/policy_study/whatif_report.h"

namespace saca::app {
namespace {

struct WhatifOptions {
  std::string scenario;
  std::vector<std::string> vary;
  std::optional<double> at;
  std::string svg = "runs/whatif.svg";
  int threads = usual_threads();
  bool as_json = false;
};

void map_policies(const WhatifOptions& options) {
  if (options.vary.size() > 2) {
    throw CLI::ValidationError("--vary", "at most twice");
  }
  const auto inputs = read_scenario_inputs(options.scenario);
  need_distinct({{"--svg", options.svg}},
                {{"the scenario", need(installation::find_scenario(here(), options.scenario))}});
  auto axes = need(policy_study::axes_of(options.vary, inputs.scenario));
  const double time = decision_time(inputs, options.at);
  need_writable({options.svg});
  policy_study::WhatifMap map{.scenario = &inputs.scenario,
                              .car = &inputs.car,
                              .time = time,
                              .axes = std::move(axes),
                              .cells = {}};
  map.cells =
      need_whole(policy_study::try_cells(map, inputs.harm, {options.threads, here().display}),
                 "interrupted; nothing was written");
  write(options.svg, policy_study::whatif_svg(map));
  tell(options.as_json, policy_study::json_of(map),
       fmt::format("{}Map: {}\n", policy_study::text_of(map), fs::absolute(options.svg).string()));
}

}  // namespace

void add_whatif(CLI::App& line) {
  const auto [command, options] = add_command<WhatifOptions>(
      line, "whatif", "Map which policy is best when one or two numbers of a scenario change",
      map_policies);
  add_scenario(command, options.scenario);
  add_needed(command, "--vary", options.vary,
             "NUMBER=FROM:TO:STEP, once or twice. As it is when the policies begin: ego.speed_mps, "
             "ego.offset_m, truck1.distance_m, truck1.offset_m, truck1.speed_mps, grip; as it "
             "stands in the scenario: any other number, by its keys and places in lists, as "
             "road.left_edge_m, truck1.start.brake_at_s, actors.0.mass_kg")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_size(1);
  add_at(command, options.at);
  add(command, "--svg", options.svg, "The map");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

}  // namespace saca::app
