#include "saca/lab/policy_study/oracle_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "saca/thinking/rollout/describe.h"

namespace saca::policy_study {
namespace {

using nlohmann::json;

json interval_of(const forecast::Mean& mean) {
  return {{"mean", mean.value}, {"low", mean.low}, {"high", mean.high}};
}

json contact_json(const collision::Contact& contact, const world::Scene& scene) {
  return {{"time_s", contact.time},
          {"with", contact.actor ? json(actor_name(scene.actors[*contact.actor])) : json()},
          {"ego_face", name(contact.ego_face)},
          {"impact_speed_mps", contact.relative_speed},
          {"ego_delta_v_mps", contact.ego_delta_v},
          {"other_delta_v_mps", contact.other_delta_v}};
}

json verdict_json(const eval::Verdict& verdict, const world::Scene& scene) {
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
    all["as_written"]["contact"] = contact_json(*written.contact, scene);
  }
  return all;
}

std::string row_of(const eval::Verdict& verdict, const world::Scene& scene) {
  const preview::PolicyFacts& facts = verdict.written.facts;
  const forecast::MeanOutcome& expected = verdict.expected;
  return fmt::format("{:26}  {:.4f} ({:.4f} to {:.4f})  {:5.2f}  {:3.0f} %   {}\n",
                     manoeuvre::plan_text(facts.plan), expected.harm.value, expected.harm.low,
                     expected.harm.high, expected.collision_loss.value,
                     100.0 * expected.contact.share, rollout::describe(facts.outcome(), scene));
}

}  // namespace

json json_of(const eval::Oracle& oracle, const OracleQuestion& question) {
  json all{{"schema", "saca.oracle/1"},   {"scenario", question.scenario},
           {"time_s", oracle.scene.time}, {"draws", question.draws},
           {"seed", question.seed},       {"policies", json::array()},
           {"ranking", json::array()}};
  for (const eval::Verdict& verdict : oracle.verdicts) {
    all["policies"].push_back(verdict_json(verdict, oracle.scene));
  }
  for (const manoeuvre::PolicyId policy : oracle.ranking) {
    all["ranking"].push_back(manoeuvre::index(policy));
  }
  const eval::Margin margin = margin_of_best(oracle);
  all["margin"] = {{"mean", margin.mean}, {"low", margin.low}};
  return all;
}

std::string text_of(const eval::Oracle& oracle, const OracleQuestion& question) {
  std::string text =
      fmt::format("At {:.2f} s, {:.1f} m/s; {} draws of what nobody knows, seed {}.\n\n",
                  oracle.scene.time, norm(oracle.scene.ego.v_B), question.draws, question.seed);
  text += "best plan of each policy    expected harm (95 %)       loss   hit     as written\n";
  for (const manoeuvre::PolicyId policy : oracle.ranking) {
    text += row_of(oracle.of(policy), oracle.scene);
  }
  for (const eval::Verdict& verdict : oracle.verdicts) {
    if (!verdict.written.facts.drivable()) {
      text += fmt::format("{} {:24}  {}\n", manoeuvre::index(verdict.written.facts.plan.policy),
                          name(verdict.written.facts.plan.policy), verdict.written.facts.refusal());
    }
  }
  const eval::Margin margin = margin_of_best(oracle);
  text += fmt::format("\nBest: {}", plan_name(oracle.of(oracle.best()).written.facts.plan));
  text +=
      fmt::format("{} (by {:.4f} harm, at least {:.4f}).\n",
                  margin.low > 0.0 ? ", alone" : ", not clearly alone", margin.mean, margin.low);
  return text;
}

}  // namespace saca::policy_study
