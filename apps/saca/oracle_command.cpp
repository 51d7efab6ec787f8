#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/moment_option.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/oracle_report.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::app {
namespace {

struct OracleCommand {
  std::string scenario;
  std::optional<double> at;
  int draws = 100;
  unsigned long seed = 1;
  int threads = usual_threads();
  std::string svg;
  bool as_json = false;
};

int run(const OracleCommand& options) {
  if (options.draws == 1) {
    complain("--draws: want 0, or 2 at least, got 1");
    return wrong_command_line;
  }
  const auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    complain(inputs.error().message);
    return bad_input;
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
  const scenario::Scenario& scenario = inputs.value().scenario;
  const eval::Oracle oracle =
      eval::oracle(scenario, inputs.value().car, inputs.value().harm,
                   {*time.value(), options.draws, options.seed, options.threads});
  if (!options.svg.empty()) {
    const std::string sheet = report::contact_sheet(policy_study::sheet_of(oracle, scenario));
    if (const auto problem = long_work::write_output(options.svg, sheet)) {
      complain(problem->message);
      return cannot_write;
    }
  }
  const policy_study::OracleQuestion question{scenario.name, options.draws, options.seed};
  if (options.as_json) {
    app::print_json(policy_study::json_of(oracle, question));
  } else {
    app::print("{}\n{}", scenario.title, policy_study::text_of(oracle, question));
  }
  return success;
}

}  // namespace

void add_oracle(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "oracle",
      "Try every plan of all eight policies at the trigger, knowing what the others will do, and "
      "rank the policies");
  const auto options = std::make_shared<OracleCommand>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  add_at(*command, options->at);
  command
      ->add_option("--draws", options->draws,
                   "Of what nobody knows beforehand, two at least; 0: as written")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Same seed, same figures")->capture_default_str();
  add_threads(*command, options->threads);
  command->add_option("--svg", options->svg, "Draw the best plan of each policy, as written");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
