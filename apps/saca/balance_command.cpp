#include "apps/saca/options.h"
#include "saca/lab/policy_study/balance_report.h"

namespace saca::app {
namespace {

struct BalanceOptions {
  installation::SurveyRequest survey;
  bool as_json = false;
};

void balance_suite(const BalanceOptions& options) {
  const auto suite = need(installation::open_suite(here(), options.survey, "balance"));
  const eval::Balance balance =
      eval::balance(need_whole(installation::survey(here(), suite, options.survey)));
  nlohmann::json figures = policy_study::json_of(balance, options.survey.suite);
  figures["meta.command"] = command_line(options.survey, "balance");
  tell(options.as_json, figures, policy_study::text_of(balance));
}

}  // namespace

void add_balance(CLI::App& line) {
  const auto [command, options] = add_command<BalanceOptions>(
      line, "balance",
      "How often each policy is strictly best in a suite of encounters; can be interrupted",
      balance_suite);
  add_survey_options(command, options.survey);
  add_json(command, options.as_json);
}

}  // namespace saca::app
