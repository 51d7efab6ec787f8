#include "apps/saca/options.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/policy_study/oracle_report.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::app {
namespace {

struct OracleOptions {
  std::string scenario;
  std::optional<double> at;
  int draws = 100;
  unsigned long seed = 1;
  int threads = usual_threads();
  std::string svg;
  bool as_json = false;
};

void ask_oracle(const OracleOptions& options) {
  if (options.draws == 1) {
    refuse(wrong_command_line, "--draws: want 0, or 2 at least, got 1");
  }
  const auto inputs = read_scenario_inputs(options.scenario);
  need_distinct({{"--svg", options.svg}},
                {{"the scenario", need(installation::find_scenario(here(), options.scenario))}});
  const double time = decision_time(inputs, options.at);
  need_writable({options.svg});
  const scenario::Scenario& scenario = inputs.scenario;
  const eval::Oracle oracle = eval::oracle(scenario, inputs.car, inputs.harm,
                                           {time, options.draws, options.seed, options.threads});
  if (!options.svg.empty()) {
    write(options.svg, report::contact_sheet(policy_study::sheet_of(oracle, scenario)));
  }
  const policy_study::OracleQuestion question{scenario.name, options.draws, options.seed};
  tell(options.as_json, policy_study::json_of(oracle, question),
       scenario.title + "\n" + policy_study::text_of(oracle, question));
}

}  // namespace

void add_oracle(CLI::App& line) {
  const auto [command, options] = add_command<OracleOptions>(
      line, "oracle",
      "Try every plan of all eight policies at the trigger, knowing what the others will do, and "
      "rank the policies",
      ask_oracle);
  add_scenario(command, options.scenario);
  add_at(command, options.at);
  add(command, "--draws", options.draws,
      "Of what nobody knows beforehand, two at least; 0: as written", CLI::Range(0, 1'000'000));
  add(command, "--seed", options.seed, "Same seed, same figures");
  add_threads(command, options.threads);
  add(command, "--svg", options.svg, "Draw the best plan of each policy, as written");
  add_json(command, options.as_json);
}

}  // namespace saca::app
