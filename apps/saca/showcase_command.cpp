#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/surveying.h"
#include "apps/saca/within.h"
#include "saca/lab/family_samples/showcase_json.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using manoeuvre::PolicyId;
using nlohmann::json;

struct ShowcaseCommand {
  SurveyOptions survey;
  eval::ShowcaseRule rule;
  unsigned long seed = 1;
  int tries = 40;
  std::string output = "runs/showcase";
  bool as_json = false;
};

std::optional<Error> write(const family_samples::ShowcaseScene& one, const std::string& output) {
  const fs::path file = fs::path(output) / (one.scenario.name + ".toml");
  if (auto problem = long_work::write_output(file, scenario::write_scenario(one.scenario))) {
    return problem;
  }
  return long_work::write_output(
      fs::path(output) / (one.scenario.name + ".svg"),
      report::contact_sheet(policy_study::sheet_of(one.oracle, one.scenario)));
}

/// What was found for all policies.
struct Found {
  json list = json::array();
  int missing = 0;  ///< scenes that are wanted and were not found
  bool interrupted = false;
};

/// Searches, writes and tells of what it finds, policy by policy.
Result<Found> search_all(const family_samples::ShowcaseSearch& search,
                         const std::vector<eval::Finding>& findings,
                         const ShowcaseCommand& options) {
  Found all;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const auto found = family_samples::showcase_scenes(search, findings, policy);
    if (!found.has_value()) {
      return found.error();
    }
    if (!found.value()) {
      all.interrupted = true;
      break;
    }
    all.missing += family_samples::wanted(policy) - static_cast<int>(found.value()->size());
    for (const family_samples::ShowcaseScene& one : *found.value()) {
      if (const auto problem = write(one, options.output)) {
        return *problem;
      }
      all.list.push_back(family_samples::json_of(one, policy));
      if (!options.as_json) {
        app::print("{}: {}\n", one.scenario.name, one.scenario.why);
      }
    }
  }
  return all;
}

int run(const ShowcaseCommand& options) {
  const auto source = open_suite(options.survey, "search-showcase");
  if (!source.has_value()) {
    return refused(source.error());
  }
  if (const auto problem =
          long_work::why_outputs_unwritable({fs::path(options.output) / "x.toml"})) {
    return refused(*problem);
  }
  const auto findings = survey(source.value(), options.survey);
  if (!findings.has_value()) {
    return refused(findings.error());
  }
  const DrawnSuite& suite = source.value();
  const auto found = findings.value() ? search_all({.source = &suite.source,
                                                    .car = &suite.inputs.car,
                                                    .harm = &suite.inputs.harm,
                                                    .rule = options.rule,
                                                    .seed = options.seed,
                                                    .tries = options.tries,
                                                    .threads = options.survey.threads,
                                                    .display = progress_display()},
                                                   *findings.value(), options)
                                      : Result(Found{.interrupted = true});
  if (!found.has_value()) {
    return refused(found.error());
  }
  const Found& all = found.value();
  if (all.interrupted) {
    complain("interrupted; the survey goes on where it stopped when the same command is given");
    return was_interrupted;
  }
  if (options.as_json) {
    app::print_json(
        json{{"schema", "saca.showcase/1"}, {"missing", all.missing}, {"found", all.list}});
  } else if (all.missing > 0) {
    app::print("{} scenes are missing: try more encounters (--count) or candidates (--tries)\n",
               all.missing);
  }
  return success;
}

}  // namespace

void add_search_showcase(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "search-showcase",
      "Search, for each policy, a scene in which it alone is best; can be interrupted");
  const auto options = std::make_shared<ShowcaseCommand>();
  add_survey_options(*command, options->survey);
  command->add_option("--clear", options->rule.clear, "Least expected harm that it spares")
      ->check(within(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--draws", options->rule.draws, "Under which it must do so")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the draws")->capture_default_str();
  command->add_option("--tries", options->tries, "Candidates of each policy that are tried")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--output", options->output, "Folder for scenarios and pictures")
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
