#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/ladder_report.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct LadderCommand {
  suites::SuiteRequest suite;
  bool as_json = false;
};

int run(LadderCommand options) {
  suites::SuiteRequest& suite = options.suite;
  const std::string name = fs::path(suite.name).filename().string();
  if (suite.output.empty()) {
    suite.output = fmt::format("runs/ladder-{}-{}.json", name, suite.split);
  }
  if (const auto problem = long_work::why_outputs_unwritable({suite.output})) {
    return refused(*problem);
  }
  suite.no_twins = true;
  const std::vector<suites::Rung> rungs = suites::rungs_with(suite.thinking, suite.danger);
  const auto ran = run_suite(suite, "ladder", suites::names_of(rungs));
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const auto climbed = suites::climb(*ran.value(), rungs, suite.seed);
  if (climbed.empty()) {
    complain(suite.name + ": no encounter could be played; the journal holds why");
    return some_failed;
  }
  const std::string text = json_text(suites::ladder_json(*ran.value(), climbed, name)) + "\n";
  auto problem = long_work::write_output(suite.output, text);
  if (!problem) {
    problem = long_work::write_output(
        fs::path(suite.output).replace_extension(".html"),
        report::suite_page(suites::ladder_page(*ran.value(), climbed, name)));
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print("{}", text);
  } else {
    app::print("{}\npage: {}\n", suites::ladder_text(climbed, suite.name),
               fs::path(suite.output).replace_extension(".html").string());
  }
  return suites::has_faults(*ran.value()) ? some_failed : success;
}

}  // namespace

void add_ladder(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "ladder",
      "Where regret comes from: what each thing that is not known costs; can be interrupted");
  const auto options = std::make_shared<LadderCommand>();
  add_suite_options(*command, options->suite);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
