#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/moment_option.h"
#include "apps/saca/pictures.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/oracle.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct OracleCommand {
  std::string scenario;
  std::optional<double> at;
  int draws = 100;
  unsigned long seed = 1;
  int threads = usual_threads();
  std::string svg;
  bool as_json = false;
};

json interval_of(const forecast::Mean& mean) {
  return {{"mean", mean.value}, {"low", mean.low}, {"high", mean.high}};
}

json json_of(const eval::Verdict& verdict, const world::Scene& scene) {
  const preview::PolicyFacts& facts = verdict.written.facts;
  json all{{"policy", manoeuvre::index(facts.plan.policy)},
           {"name", name(facts.plan.policy)},
           {"target_speed_mps", facts.plan.target_speed ? json(*facts.plan.target_speed) : json()},
           {"strength", facts.plan.strength ? json(*facts.plan.strength) : json()},
           {"refusal", facts.drivable() ? json() : json(facts.refusal())}};
  if (!facts.drivable()) {
    return all;
  }
  all["harm"] = interval_of(verdict.expected.harm);
  all["collision_loss"] = interval_of(verdict.expected.collision_loss);
  all["behind_best"] = interval_of(verdict.behind);
  all["contact_share"] = {{"mean", verdict.expected.contact.share},
                          {"low", verdict.expected.contact.low},
                          {"high", verdict.expected.contact.high}};
  const collision::Outcome& written = facts.outcome();
  all["as_written"] = {{"harm", written.harm},
                       {"collision_loss", written.collision_loss},
                       {"clearance_m", written.clearance},
                       {"text", rollout::describe(written, scene)}};
  if (written.contact) {
    const collision::Contact& contact = *written.contact;
    all["as_written"]["contact"] = {
        {"time_s", contact.time},
        {"with", contact.actor ? json(actor_name(scene.actors[*contact.actor])) : json()},
        {"ego_face", name(contact.ego_face)},
        {"impact_speed_mps", contact.relative_speed},
        {"ego_delta_v_mps", contact.ego_delta_v},
        {"other_delta_v_mps", contact.other_delta_v}};
  }
  return all;
}

std::string row_of(const eval::Verdict& verdict, const world::Scene& scene) {
  const preview::PolicyFacts& facts = verdict.written.facts;
  const forecast::MeanOutcome& expected = verdict.expected;
  return fmt::format("{:26}  {:.4f} ({:.4f} to {:.4f})  {:5.2f}  {:3.0f} %   {}",
                     manoeuvre::plan_text(facts.plan), expected.harm.value, expected.harm.low,
                     expected.harm.high, expected.collision_loss.value,
                     100.0 * expected.contact.share, rollout::describe(facts.outcome(), scene));
}

void print(const eval::Oracle& oracle, const OracleCommand& options) {
  app::print("At {:.2f} s, {:.1f} m/s; {} draws of what nobody knows, seed {}.\n\n",
             oracle.scene.time, norm(oracle.scene.ego.v_B), options.draws, options.seed);
  app::print("best plan of each policy    expected harm (95 %)       loss   hit     as written\n");
  for (const manoeuvre::PolicyId policy : oracle.ranking) {
    app::print("{}\n", row_of(oracle.of(policy), oracle.scene));
  }
  for (const eval::Verdict& verdict : oracle.verdicts) {
    if (!verdict.written.facts.drivable()) {
      app::print("{} {:24}  {}\n", manoeuvre::index(verdict.written.facts.plan.policy),
                 name(verdict.written.facts.plan.policy), verdict.written.facts.refusal());
    }
  }
  const eval::Margin margin = margin_of_best(oracle);
  app::print("\nBest: {}", plan_name(oracle.of(oracle.best()).written.facts.plan));
  app::print("{} (by {:.4f} harm, at least {:.4f}).\n",
             margin.low > 0.0 ? ", alone" : ", not clearly alone", margin.mean, margin.low);
}

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
    const std::string sheet = report::contact_sheet(sheet_of(oracle, scenario));
    auto problem = long_work::write_output(options.svg, sheet);
    if (problem) {
      complain(problem->message);
      return cannot_write;
    }
  }
  if (!options.as_json) {
    app::print("{}\n", scenario.title);
    print(oracle, options);
    return success;
  }
  json all{{"schema", "saca.oracle/1"}, {"scenario", scenario.name}, {"time_s", oracle.scene.time},
           {"draws", options.draws},    {"seed", options.seed},      {"policies", json::array()},
           {"ranking", json::array()}};
  for (const eval::Verdict& verdict : oracle.verdicts) {
    all["policies"].push_back(json_of(verdict, oracle.scene));
  }
  for (const manoeuvre::PolicyId policy : oracle.ranking) {
    all["ranking"].push_back(manoeuvre::index(policy));
  }
  const eval::Margin margin = margin_of_best(oracle);
  all["margin"] = {{"mean", margin.mean}, {"low", margin.low}};
  app::print_json(all);
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
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--svg", options->svg, "Draw the best plan of each policy, as written");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
