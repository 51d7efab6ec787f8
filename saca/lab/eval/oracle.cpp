#include "saca/lab/eval/oracle.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::eval {
namespace {

using manoeuvre::num_policies;
using manoeuvre::PolicyId;
using Tried = std::vector<collision::Outcome>;  // one a plan; meaningless where refused

std::vector<std::vector<encounter::Hindsight>> tried_of(std::span<const DecisionPoint> points,
                                                        const manoeuvre::Car& car,
                                                        const collision::HarmModel& harm,
                                                        const OracleOptions& options) {
  if (!options.only_defaults) {
    return encounter::all_plans_tried(points, car, harm, forecast::Braking::any_strength,
                                      options.threads);
  }
  std::vector<std::vector<encounter::Hindsight>> all;
  for (encounter::Hindsights& tried : hindsights(points, car, harm, options.threads)) {
    all.emplace_back(std::move_iterator(tried.begin()), std::move_iterator(tried.end()));
  }
  return all;
}

Tried outcomes_of(const std::vector<encounter::Hindsight>& tried) {
  Tried outcomes(tried.size());
  std::transform(tried.begin(), tried.end(), outcomes.begin(), [](const encounter::Hindsight& one) {
    return one.facts.drivable() ? one.facts.outcome() : collision::Outcome{};
  });
  return outcomes;
}

/// All worlds. What can be driven is the same in all: the ego believes in the same start.
std::vector<Tried> all_draws(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                             const collision::HarmModel& harm, const OracleOptions& options) {
  constexpr std::size_t at_once = 32;  // else thousands of motions would be kept
  const auto num_draws = static_cast<std::size_t>(options.draws);
  std::vector<Tried> draws;
  draws.reserve(num_draws);
  while (draws.size() < num_draws) {
    std::vector<DecisionPoint> points(std::min(at_once, num_draws - draws.size()));
    in_parallel(points.size(), options.threads, [&](std::size_t k) {
      const scenario::Chance chance =
          scenario::draw_chance(options.seed, draws.size() + k, options.time);
      points[k] = decision_point_at(scenario, car, options.time, chance);
    });
    for (const auto& tried : tried_of(points, car, harm, options)) {
      draws.push_back(outcomes_of(tried));
    }
  }
  return draws;
}

/// What is sure: one outcome, without an interval.
forecast::MeanOutcome sure(const collision::Outcome& outcome) {
  const double hit = outcome.contact ? 1.0 : 0.0;
  return {
      .harm = {outcome.harm, outcome.harm, outcome.harm},
      .collision_loss = {outcome.collision_loss, outcome.collision_loss, outcome.collision_loss},
      .contact = {hit, hit, hit}};
}

/// For the one ordering: mean harm and mean clearance.
collision::Outcome on_average(const std::vector<collision::Outcome>& outcomes) {
  collision::Outcome mean;
  mean.clearance = 0.0;
  for (const collision::Outcome& outcome : outcomes) {
    mean.harm += outcome.harm / static_cast<double>(outcomes.size());
    mean.clearance += outcome.clearance / static_cast<double>(outcomes.size());
  }
  return mean;
}

/// All plans, what they end in, and which of them stands for its policy.
struct PlanComparison {
  std::vector<encounter::Hindsight> written;              // with nothing left to chance
  std::vector<std::vector<collision::Outcome>> by_draws;  // of each plan
  Tried average;                                          // without draws: as written
  std::array<std::optional<std::size_t>, num_policies> stands;

  [[nodiscard]] std::size_t plan_of(PolicyId policy) const {
    return *stands[manoeuvre::index(policy)];
  }
};

PlanComparison compared(std::vector<encounter::Hindsight> written,
                        const std::vector<Tried>& draws) {
  PlanComparison plans{.written = std::move(written), .by_draws = {}, .average = {}, .stands = {}};
  plans.by_draws.resize(plans.written.size());
  plans.average = outcomes_of(plans.written);
  for (std::size_t i = 0; i < plans.written.size(); ++i) {
    const preview::PolicyFacts& facts = plans.written[i].facts;
    std::optional<std::size_t>& of_policy = plans.stands[manoeuvre::index(facts.plan.policy)];
    if (!facts.drivable()) {
      of_policy = of_policy.value_or(i);
      continue;
    }
    for (const Tried& draw : draws) {
      plans.by_draws[i].push_back(draw[i]);
    }
    if (!draws.empty()) {
      plans.average[i] = on_average(plans.by_draws[i]);
    }
    if (!of_policy || !plans.written[*of_policy].facts.drivable() ||
        collision::harm_class(plans.average[i].harm) <
            collision::harm_class(plans.average[*of_policy].harm)) {
      of_policy = i;
    }
  }
  return plans;
}

}  // namespace

Oracle oracle(const scenario::Scenario& scenario, const manoeuvre::Car& car,
              const collision::HarmModel& harm, const OracleOptions& options) {
  expects(options.draws == 0 || options.draws >= 2, "draws is 0, or 2 at least");
  expects(options.threads >= 1, "threads >= 1");
  const DecisionPoint point = decision_point_at(scenario, car, options.time);
  const PlanComparison plans =
      compared(std::move(tried_of({&point, 1}, car, harm, options).front()),
               all_draws(scenario, car, harm, options));
  const bool is_sure = options.draws == 0;
  Oracle told;
  told.scene = point.scene;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::size_t plan = plans.plan_of(policy);
    Verdict& verdict = told.verdicts[manoeuvre::index(policy)];
    verdict.written = plans.written[plan];
    if (verdict.written.facts.drivable()) {
      verdict.expected =
          is_sure ? sure(plans.average[plan]) : forecast::expected(plans.by_draws[plan]);
      told.ranking.push_back(policy);
    }
  }
  const auto average = [&](PolicyId policy) -> const collision::Outcome& {
    return plans.average[plans.plan_of(policy)];
  };
  std::sort(told.ranking.begin(), told.ranking.end(), [&](PolicyId a, PolicyId b) {
    return collision::better(average(a), a, average(b), b);
  });
  const PolicyId best = told.best();
  for (const PolicyId policy : told.ranking) {
    const double more = average(policy).harm - average(best).harm;
    told.verdicts[manoeuvre::index(policy)].behind =
        is_sure ? forecast::Mean{more, more, more}
                : forecast::harm_difference(plans.by_draws[plans.plan_of(policy)],
                                            plans.by_draws[plans.plan_of(best)]);
  }
  return told;
}

Margin margin_of_best(const Oracle& oracle) {
  std::optional<Margin> least;
  for (const PolicyId policy : oracle.ranking) {
    const forecast::Mean& behind = oracle.of(policy).behind;
    if (policy != oracle.best() && (!least || behind.value < least->mean)) {
      least = Margin{behind.value, behind.low};
    }
  }
  return least.value_or(Margin{});
}

}  // namespace saca::eval
