#include "saca/lab/eval/judged_encounter.h"

#include <utility>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/encounter/recorded_driver.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/oracle.h"
#include "saca/lab/eval/trigger_case.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::eval {
namespace {

void take_verdict(const reflex::Verdict& verdict, JudgedEncounter& judged) {
  judged.one.told = encounter::forecast_harms(verdict);
  judged.admissible_harm = reflex::admissible_harm(verdict);
  judged.speaks_for = reflex::plan_of(verdict);
  judged.plans.reserve(verdict.plans.size());
  for (const reflex::JudgedPlan& plan : verdict.plans) {
    if (plan.drivable) {
      judged.plans.push_back(
          {plan.plan, plan.harm, plan.contact, reflex::admits(verdict, plan.plan)});
    }
  }
}

void take_oracle(const Oracle& told, int draws, JudgedEncounter& judged) {
  memory::PolicyHarms harms;
  for (const manoeuvre::PolicyId policy : told.ranking) {
    const Verdict& verdict = told.of(policy);
    const std::size_t place = manoeuvre::index(policy);
    harms[place] = verdict.expected.harm.value;
    judged.happened[place] = PolicyOverDraws{.plan = verdict.written.facts.plan,
                                             .harm = verdict.expected.harm,
                                             .contact = verdict.expected.contact.share};
  }
  memory::Case& one = judged.one;
  const Verdict& best = told.of(told.best());
  one.plan = best.written.facts.plan;
  one.best = told.best();
  one.harm = best.expected.harm.value;
  one.best_harm = one.harm;
  one.collision_loss = best.expected.collision_loss.value;
  one.happened = harms;
  one.draws = draws;
}

}  // namespace

std::optional<WrittenTrigger> trigger_as_written(const scenario::Scenario& scenario,
                                                 const manoeuvre::Car& car,
                                                 const collision::HarmModel& harm) {
  const auto time = trigger_time(scenario, car);
  if (!time) {
    return std::nullopt;
  }
  const DecisionPoint point = decision_point_at(scenario, car, *time);
  const rollout::Attempt nothing{manoeuvre::doing_nothing, &point.scene, &point.others, point.grip,
                                 point.perturbation};
  const preview::RolledOut tried = std::move(preview::tried(car, {&nothing, 1}, harm).front());
  WrittenTrigger found{.time = *time, .contact = std::nullopt};
  if (!tried.facts.drivable() || !tried.facts.outcome().contact) {
    return found;
  }
  const collision::Contact& contact = *tried.facts.outcome().contact;
  const auto& actors = point.scene.actors;
  WithoutAvoidance without{
      .met = contact.actor ? world::actor_name(actors[*contact.actor]) : std::string("edge"),
      .ego_face = contact.ego_face,
      .other_face = contact.other_face,
      .relative_speed = contact.relative_speed,
      .after = contact.time - point.scene.time};
  without.first_actor =
      contact.actor && without.met == scenario::actor_name(scenario.actors.front());
  found.contact = std::move(without);
  return found;
}

Result<std::optional<JudgedEncounter>> judged_encounter(
    const encounter::Stage& stage, const preview::ForecastTools& tools,
    const JudgingOptions& options, const std::vector<memory::MadeWith>& made_with) {
  const auto played = played_to_trigger(stage);
  if (!played.has_value()) {
    return played.error();
  }
  if (!played.value()) {
    return std::optional<JudgedEncounter>();
  }
  const encounter::ClosedLoop& now = *played.value();
  JudgedEncounter judged;
  judged.one = encounter::case_of(now.seen(), now.beliefs(), *stage.scenario);
  judged.one.made_with = made_with;
  take_verdict(arbitration::Forecaster(tools, options.told_draws).judge(now.seen(), now.beliefs()),
               judged);
  take_oracle(oracle(*stage.scenario, *stage.car, *stage.harm,
                     {.time = now.time(), .draws = options.draws, .seed = options.seed}),
              options.draws, judged);
  if (const auto driver =
          encounter::recorded_driver(*stage.scenario, *stage.car, *stage.harm, now.time())) {
    judged.driver = encounter::policy_of(*driver);
  }
  return std::optional(std::move(judged));
}

}  // namespace saca::eval
