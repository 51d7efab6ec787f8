#include <fmt/core.h>

#include <algorithm>
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
#include "saca/base/core/file.h"
#include "saca/lab/eval/showcase.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
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

/// How many scenes are wanted of each policy.
int wanted(PolicyId policy) {
  return policy == PolicyId::no_intervention ? 3 : 1;
}

struct ShowcasePage {
  scenario::Scenario scenario;
  eval::Oracle oracle;

  /// How often the right policy meets somebody all the same.
  [[nodiscard]] double contact_share() const {
    return oracle.of(oracle.best()).expected.contact.share;
  }
};

/// A sample as a scenario of its own.
void give_name(ShowcasePage& one, PolicyId policy, std::size_t index) {
  scenario::Scenario& scenario = one.scenario;
  scenario.name = fmt::format("showcase_{}", manoeuvre::index(policy));
  if (wanted(policy) > 1) {
    scenario.name += fmt::format("_{}", static_cast<char>('a' + index));
  }
  scenario.title = fmt::format("{} is right: {}", name(policy), scenario.title);
  scenario.why = why_right(one.oracle, policy);
}

/// Of the first candidates those that convince, and of these the ones in which the right policy
/// meets somebody least often; fewer than wanted where too few do. nullopt: interrupted.
Result<std::optional<std::vector<ShowcasePage>>> shown(const DrawnSuite& suite,
                                                       const std::vector<eval::Finding>& findings,
                                                       PolicyId policy,
                                                       const ShowcaseCommand& options) {
  constexpr double hardly_ever = 0.02;
  std::vector<ShowcasePage> found;
  const auto all = eval::candidates(findings, policy);
  const auto count = std::min(all.size(), static_cast<std::size_t>(options.tries));
  SteadyClock clock;
  long_work::ProgressLine progress(fmt::format("{} under noise", name(policy)),
                                   std::max(1, static_cast<int>(count)), clock, progress_display());
  int good = 0;
  for (std::size_t i = 0; i < count && good < wanted(policy); ++i) {
    if (long_work::interrupted()) {
      return std::optional<std::vector<ShowcasePage>>();
    }
    const auto sample = suite.source.sample(all[i].number);
    if (!sample.has_value()) {
      return sample.error();
    }
    const scenario::Scenario& scenario = sample.value().scenario;
    ShowcasePage one{scenario, eval::oracle(scenario, suite.inputs.car, suite.inputs.harm,
                                            {.time = *all[i].time,
                                             .draws = options.rule.draws,
                                             .seed = options.seed,
                                             .threads = options.survey.threads,
                                             .only_defaults = true})};
    if (convinces(one.oracle, policy, options.rule)) {
      good += one.contact_share() <= hardly_ever ? 1 : 0;
      found.push_back(std::move(one));
    }
    progress.show(static_cast<int>(i) + 1, 0,
                  fmt::format(" candidates, {} convince", found.size()));
  }
  std::stable_sort(found.begin(), found.end(), [](const ShowcasePage& a, const ShowcasePage& b) {
    return a.contact_share() < b.contact_share();
  });
  found.resize(std::min(found.size(), static_cast<std::size_t>(wanted(policy))));
  for (std::size_t i = 0; i < found.size(); ++i) {
    give_name(found[i], policy, i);
  }
  return std::optional(std::move(found));
}

std::optional<Error> write(const ShowcasePage& one, const std::string& output) {
  const fs::path file = fs::path(output) / (one.scenario.name + ".toml");
  if (auto problem = long_work::write_output(file, scenario::write_scenario(one.scenario))) {
    return problem;
  }
  return long_work::write_output(
      fs::path(output) / (one.scenario.name + ".svg"),
      report::contact_sheet(policy_study::sheet_of(one.oracle, one.scenario)));
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
  bool stopped = !findings.value();
  json list = json::array();
  int missing = 0;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (stopped) {
      break;
    }
    const auto found = shown(source.value(), *findings.value(), policy, options);
    if (!found.has_value()) {
      return refused(found.error());
    }
    stopped = !found.value();
    if (stopped) {
      break;
    }
    missing += wanted(policy) - static_cast<int>(found.value()->size());
    for (const ShowcasePage& one : *found.value()) {
      if (const auto problem = write(one, options.output)) {
        return refused(*problem);
      }
      const eval::Margin margin = margin_of_best(one.oracle);
      list.push_back({{"policy", manoeuvre::index(policy)},
                      {"scenario", one.scenario.name},
                      {"margin", margin.mean},
                      {"margin_low", margin.low},
                      {"why", one.scenario.why}});
      if (!options.as_json) {
        app::print("{}: {}\n", one.scenario.name, one.scenario.why);
      }
    }
  }
  if (stopped) {
    complain("interrupted; the survey goes on where it stopped when the same command is given");
    return was_interrupted;
  }
  if (options.as_json) {
    app::print_json(json{{"schema", "saca.showcase/1"}, {"missing", missing}, {"found", list}});
  } else if (missing > 0) {
    app::print("{} scenes are missing: try more encounters (--count) or candidates (--tries)\n",
               missing);
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
