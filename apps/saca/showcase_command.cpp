#include "apps/saca/options.h"
#include "saca/lab/family_samples/showcase_json.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::app {
namespace {

using nlohmann::json;

constexpr const char* survey_goes_on =
    "interrupted; the survey goes on where it stopped when the same command is given";

struct ShowcaseOptions {
  installation::SurveyRequest survey;
  eval::ShowcaseRule rule;
  unsigned long seed = 1;
  int tries = 40;
  std::string output = "runs/showcase";
  bool as_json = false;
};

/// The scenes of one policy, each written as a scenario and a picture, and told of.
std::vector<family_samples::ShowcaseScene> search_policy(
    const family_samples::ShowcaseSearch& search, const std::vector<eval::Finding>& findings,
    manoeuvre::PolicyId policy, const ShowcaseOptions& options) {
  auto found =
      need_whole(family_samples::showcase_scenes(search, findings, policy), survey_goes_on);
  for (const family_samples::ShowcaseScene& one : found) {
    const fs::path file = fs::path(options.output) / one.scenario.name;
    write(file.string() + ".toml", scenario::write_scenario(one.scenario));
    write(file.string() + ".svg",
          report::contact_sheet(policy_study::sheet_of(one.oracle, one.scenario)));
    tell_meanwhile(options.as_json, fmt::format("{}: {}\n", one.scenario.name, one.scenario.why));
  }
  return found;
}

void search_showcases(const ShowcaseOptions& options) {
  const auto suite = need(installation::open_suite(here(), options.survey, "search-showcase"));
  need_writable({fs::path(options.output) / "x.toml"});
  const auto findings =
      need_whole(installation::survey(here(), suite, options.survey), survey_goes_on);
  const family_samples::ShowcaseSearch search{.source = &suite.source,
                                              .car = &suite.inputs.car,
                                              .harm = &suite.inputs.harm,
                                              .rule = options.rule,
                                              .seed = options.seed,
                                              .tries = options.tries,
                                              .threads = options.survey.threads,
                                              .display = here().display};
  json list = json::array();
  int missing = 0;  // scenes that are wanted and were not found
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const auto found = search_policy(search, findings, policy, options);
    missing += family_samples::wanted(policy) - static_cast<int>(found.size());
    for (const family_samples::ShowcaseScene& one : found) {
      list.push_back(family_samples::json_of(one, policy));
    }
  }
  const std::string text =
      missing > 0
          ? fmt::format(
                "{} scenes are missing: try more encounters (--count) or candidates (--tries)\n",
                missing)
          : "";
  tell(options.as_json,
       json{{"schema", "saca.showcase/1"}, {"missing", missing}, {"found", std::move(list)}}, text);
}

}  // namespace

void add_search_showcase(CLI::App& line) {
  const auto [command, options] = add_command<ShowcaseOptions>(
      line, "search-showcase",
      "Search, for each policy, a scene in which it alone is best; can be interrupted",
      search_showcases);
  add_survey_options(command, options.survey);
  add(command, "--clear", options.rule.clear, "Least expected harm that it spares",
      within(0.0, 10.0));
  add(command, "--draws", options.rule.draws, "Under which it must do so",
      CLI::Range(2, 1'000'000));
  add(command, "--seed", options.seed, "Of the draws");
  add(command, "--tries", options.tries, "Candidates of each policy that are tried",
      CLI::Range(1, 1'000'000));
  add(command, "--output", options.output, "Folder for scenarios and pictures");
  add_json(command, options.as_json);
}

}  // namespace saca::app
