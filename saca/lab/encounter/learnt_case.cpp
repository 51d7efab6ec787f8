#include "saca/lab/encounter/learnt_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "saca/base/core/contract.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/thinking/preview/preview.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::encounter {
namespace {

void take_least(memory::PolicyHarms& harms, const manoeuvre::Plan& plan, double harm) {
  std::optional<double>& least = harms.at(manoeuvre::index(plan.policy));
  least = std::min(least.value_or(harm), harm);
}

}  // namespace

std::vector<memory::MadeWith> made_with(const preview::ForecastTools& tools,
                                        const intent::Model& intent, const std::string& car) {
  preview::ForecastTools without_cues = tools;  // forecast_harms are those as seen
  without_cues.cues = nullptr;
  std::vector<memory::MadeWith> inputs;
  for (const nlohmann::json& one : inputs_json(without_cues, intent, car)) {
    const nlohmann::json& digest = one.at("digest");
    inputs.push_back({one.at("what").get<std::string>(), one.at("name").get<std::string>(),
                      digest.is_string() ? digest.get<std::string>() : ""});
  }
  return inputs;
}

memory::PolicyHarms forecast_harms(const reflex::Verdict& verdict) {
  memory::PolicyHarms harms;
  for (const reflex::JudgedPlan& one : verdict.plans) {
    if (one.drivable) {
      take_least(harms, one.plan, one.as_seen.value_or(one.harm));
    }
  }
  return harms;
}

memory::PolicyHarms happened_harms(std::span<const preview::RolledOut> tried) {
  memory::PolicyHarms harms;
  for (const preview::RolledOut& one : tried) {
    if (one.facts.drivable()) {
      take_least(harms, one.facts.plan, one.facts.outcome().harm);
    }
  }
  return harms;
}

memory::Case case_of(const world::Scene& seen, const intent::Beliefs& beliefs,
                     const scenario::Scenario& scenario) {
  memory::Case one{
      .scene = seen,
      .source = scenario.name,
      .origin = scenario.provenance ? memory::Origin::recording : memory::Origin::simulation};
  for (const intent::Belief& belief : beliefs) {
    one.intentions.push_back(belief.now());
  }
  return one;
}

memory::Case learnt_case(const Setup& setup, const Record& record, const Trigger& trigger) {
  expects(record.decision && record.hindsight && record.best, "something was decided");
  const reflex::Decision& decision = *record.decision;
  const preview::PolicyFacts& best = (*record.hindsight)[manoeuvre::index(*record.best)].facts;
  memory::Case one = case_of(trigger.seen, trigger.beliefs, *setup.scenario);
  one.plan = decision.plan;
  one.best = *record.best;
  one.harm = record.result.harm;
  one.best_harm = best.outcome().harm;
  one.collision_loss = record.result.collision_loss;
  one.review = fmt::format("{}: {}; best {}: {}", name(decision.plan.policy),
                           rollout::describe(record.result, record.met), name(*record.best),
                           rollout::describe(best.outcome(), trigger.point.scene));
  one.happened =
      happened_harms(all_plans_tried({&trigger.point, 1}, *setup.car, *setup.harm).front());
  const preview::ForecastTools tools{setup.car, setup.harm, setup.atlas, setup.danger};
  one.made_with = made_with(tools, *setup.intent, setup.scenario->car);
  if (decision.verdict) {
    one.told = forecast_harms(*decision.verdict);
  }
  for (const danger::ObstacleRisk& risk : preview::obstacle_risks(trigger.seen, tools)) {
    one.risks.push_back(risk.risk);
  }
  return one;
}

std::optional<match::CaseId> followed_case(const reflex::Decision& decision,
                                           std::span<const arbitration::Preview> previews) {
  if (decision.source != reflex::Source::memory || !decision.preview) {
    return std::nullopt;
  }
  const arbitration::Preview* const preview =
      arbitration::find_preview(previews, *decision.preview);
  return preview != nullptr && preview->nearest ? std::optional(preview->nearest->found.id)
                                                : std::nullopt;
}

std::optional<match::CaseId> refuted_case(const Record& record) {
  expects(record.decision && record.hindsight, "something was decided");
  const collision::Outcome& braking =
      (*record.hindsight)[manoeuvre::index(manoeuvre::PolicyId::aeb)].facts.outcome();
  return record.result.harm > braking.harm + reflex::material_harm
             ? followed_case(*record.decision, record.previews)
             : std::nullopt;
}

std::optional<Error> quarantine(memory::Store& memory, match::CaseId id) {
  return memory.change(id, [](memory::Case& wrong) {
    wrong.trust = memory::Trust::quarantined;
    return true;
  });
}

Result<memory::LearningResult> learn(memory::Store& memory, const memory::Case& one,
                                     const std::optional<match::CaseId>& refuted,
                                     std::size_t bound) {
  if (refuted) {
    if (auto error = quarantine(memory, *refuted)) {
      return *std::move(error);
    }
  }
  auto learnt = memory.learn(one);
  if (!learnt.has_value()) {
    return learnt;
  }
  if (auto problem = memory.catch_up()) {
    return *std::move(problem);
  }
  if (memory::is_on_a_server(memory.name())) {
    return learnt;
  }
  const auto gone = memory::keep_within(memory, bound, learnt.value().id);
  if (!gone.has_value()) {
    return Error{gone.error().code,
                 "the encounter is learnt, but the bank is not thinned: " + gone.error().message};
  }
  return learnt;
}

std::optional<Error> keep_lesson(memory::Store& memory, match::CaseId id,
                                 const language_model::Review& review) {
  if (review.shown.from == language_model::Explanation::From::facts) {
    return std::nullopt;
  }
  return memory.change(id, [&](memory::Case& one) {
    memory::add_lessons(one, {&review.shown.text, 1});
    return true;
  });
}

}  // namespace saca::encounter
