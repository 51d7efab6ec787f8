#include <fmt/core.h>

#include <memory>
#include <string>
#include <utility>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "apps/saca/within.h"
#include "saca/lab/banks/case_build.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::app {
namespace {

struct BuildOptions {
  suites::SuiteRequest from;  ///< which encounters; nobody acts in them
  std::size_t draws = 64;
  bool no_twins = false;
  bool as_json = false;
};

Result<std::optional<banks::CaseBuild>> built_cases(const BuildOptions& options,
                                                    const std::string& command) {
  const suites::SuiteRequest& from = options.from;
  auto opened = open_encounters(from, command);
  if (!opened.has_value()) {
    return opened.error();
  }
  SuiteEncounters encounters = std::move(opened).value();
  const auto planes = open_planes(std::move(encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  return banks::build_cases(
      {.at = encounters.at,
       .count = static_cast<std::size_t>(encounters.count),
       .play = {.seed = from.seed, .exact = from.exact},
       .twins = options.no_twins ? banks::TwinCases::left_out : banks::TwinCases::made},
      case_tools(*planes.value(), options.draws),
      {.journal = from.journal.empty() ? from.output + ".journal" : from.journal,
       .title = fmt::format("saca {} {} of {}", version_text(), command, encounters.what),
       .progress = "memory of " + from.name,
       .threads = from.threads,
       .display = progress_display()});
}

int build(const BuildOptions& options) {
  const suites::SuiteRequest& from = options.from;
  if (const auto problem = long_work::why_outputs_unwritable({from.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const std::string command =
      fmt::format("memory build {} --split {} --car {} --seed {} --draws {}{}{}", from.name,
                  from.split, from.car, from.seed, options.draws, from.exact ? " --exact" : "",
                  options.no_twins ? " --no-twins" : "");
  const auto built = built_cases(options, command);
  if (!built.has_value()) {
    return refused(built.error());
  }
  if (!built.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const banks::CaseBuild& cases = *built.value();
  complain_of(cases.problems);
  if (const auto problem = long_work::write_output(from.output, memory::cases_text(cases.cases))) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(json_of(cases, command, SACA_VERSION));
  } else {
    app::print("{}", text_of(cases, from.output));
  }
  return cases.problems.empty() ? success : some_failed;
}

}  // namespace

void add_memory_build(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "build", "Makes cases of the encounters of a suite, as JSON Lines for `import`");
  const auto options = std::make_shared<BuildOptions>();
  suites::SuiteRequest& from = options->from;
  from.split = "tuning";
  from.output = "runs/cases.jsonl";
  add_encounter_options(*command, from);
  command->add_option("--draws", options->draws, "That expected harm is the mean of")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_flag("--no-twins", options->no_twins,
                    "Without those without risk: a memory of accidents alone expects them");
  command->add_option("--output,-o", from.output, "Where the cases go")->capture_default_str();
  command->add_option("--journal", from.journal,
                      "What was found so far (default: beside the output)");
  add_threads(*command, from.threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = build(*options); });
}

}  // namespace saca::app
