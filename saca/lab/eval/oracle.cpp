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

}  // namespace

Oracle oracle(const scenario::Scenario& scenario, const manoeuvre::Car& car,
              const collision::HarmModel& harm, const OracleOptions& options) {
  expects(options.draws == 0 || options.draws >= 2, "draws is 0, or 2 at least");
  expects(options.threads >= 1, "threads >= 1");
  Oracle told;
  const DecisionPoint point = decision_point_at(scenario, car, options.time);
  told.scene = point.scene;
  const std::vector<encounter::Hindsight> written =
      std::move(tried_of({&point, 1}, car, harm, options).front());
  const Tried as_written = outcomes_of(written);
  const std::vector<Tried> draws = all_draws(scenario, car, harm, options);
  std::vector<std::vector<collision::Outcome>> outcomes(written.size());  // of a plan, by draws
  Tried average = as_written;
  std::array<std::optional<std::size_t>, num_policies> stands;  // which plan for its policy
  for (std::size_t i = 0; i < written.size(); ++i) {
    std::optional<std::size_t>& of_policy = stands[manoeuvre::index(written[i].facts.plan.policy)];
    if (!written[i].facts.drivable()) {
      of_policy = of_policy.value_or(i);
      continue;
    }
    for (const Tried& draw : draws) {
      outcomes[i].push_back(draw[i]);
    }
    if (!draws.empty()) {
      average[i] = on_average(outcomes[i]);
    }
    if (!of_policy || !written[*of_policy].facts.drivable() ||
        collision::harm_class(average[i].harm) < collision::harm_class(average[*of_policy].harm)) {
      of_policy = i;
    }
  }
  const auto plan_of = [&](PolicyId policy) { return *stands[manoeuvre::index(policy)]; };
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::size_t plan = plan_of(policy);
    Verdict& verdict = told.verdicts[manoeuvre::index(policy)];
    verdict.written = written[plan];
    if (verdict.written.facts.drivable()) {
      verdict.expected =
          draws.empty() ? sure(as_written[plan]) : forecast::expected(outcomes[plan]);
      told.ranking.push_back(policy);
    }
  }
  std::sort(told.ranking.begin(), told.ranking.end(), [&](PolicyId a, PolicyId b) {
    return collision::better(average[plan_of(a)], a, average[plan_of(b)], b);
  });
  const std::size_t best = plan_of(told.best());
  for (const PolicyId policy : told.ranking) {
    const std::size_t plan = plan_of(policy);
    const double more = average[plan].harm - average[best].harm;
    told.verdicts[manoeuvre::index(policy)].behind =
        draws.empty() ? forecast::Mean{more, more, more}
                      : forecast::harm_difference(outcomes[plan], outcomes[best]);
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
