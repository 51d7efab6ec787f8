#include <memory>
#include <nlohmann/json.hpp>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/surveying.h"
#include "saca/lab/policy_study/balance_report.h"

namespace saca::app {
namespace {

struct BalanceCommand {
  SurveyOptions survey;
  bool as_json = false;
};

int run(const BalanceCommand& options) {
  const auto source = open_suite(options.survey, "balance");
  if (!source.has_value()) {
    return refused(source.error());
  }
  const auto found = survey(source.value(), options.survey);
  if (!found.has_value()) {
    return refused(found.error());
  }
  if (!found.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const eval::Balance balance = eval::balance(*found.value());
  if (options.as_json) {
    nlohmann::json all = policy_study::json_of(balance, options.survey.suite);
    all["meta.command"] = command_line(options.survey, "balance");
    app::print_json(all);
  } else {
    app::print("{}", policy_study::text_of(balance));
  }
  return success;
}

}  // namespace

void add_balance(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "balance",
      "How often each policy is strictly best in a suite of encounters; can be interrupted");
  const auto options = std::make_shared<BalanceCommand>();
  add_survey_options(*command, options->survey);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
