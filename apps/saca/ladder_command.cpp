#include "apps/saca/options.h"
#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/ladder_report.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::app {
namespace {

struct LadderOptions {
  suites::SuiteRequest suite;
  bool as_json = false;
};

ExitCode climb_ladder(const LadderOptions& options) {
  suites::SuiteRequest suite = options.suite;
  suite.no_twins = true;
  const std::string name = fs::path(suite.name).filename().string();
  if (suite.output.empty()) {
    suite.output = fmt::format("runs/ladder-{}-{}.json", name, suite.split);
  }
  refuse_endings(suite.output, {".html"});
  need_distinct({{"--output", suite.output}},
                {{"--memory", suite.thinking.memory}, {"--danger", suite.danger}});
  need_writable({suite.output});
  const std::vector<suites::Rung> rungs = suites::rungs_with(suite.thinking, suite.danger);
  const auto run = need_whole(suites::run_suite(here(), suite, "ladder", suites::names_of(rungs)));
  const auto climbed = suites::climb(run, rungs, suite.seed);
  const std::string failures = suites::failures_text(run);
  if (climbed.empty()) {
    refuse(some_failed, suite.name + ": " + failures);
  }
  const nlohmann::json figures = suites::ladder_json(run, climbed, name);
  const fs::path page = fs::path(suite.output).replace_extension(".html");
  write(suite.output, json_text(figures));
  write(page, report::suite_page(suites::ladder_page(run, climbed, name)));
  tell(options.as_json, figures,
       fmt::format("{}\npage: {}\n", suites::ladder_text(run, climbed, suite.name), page.string()));
  return failures.empty() ? success : some_failed;
}

}  // namespace

void add_ladder(CLI::App& line) {
  const auto [command, options] = add_command<LadderOptions>(
      line, "ladder",
      "Where regret comes from: what each thing that is not known costs; can be interrupted",
      climb_ladder);
  add_suite_options(command, options.suite);
  command.get_option("--output")->description("Figures; beside them .html (default: runs/...)");
  add_json(command, options.as_json);
}

}  // namespace saca::app
