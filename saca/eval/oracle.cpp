#include "saca/eval/oracle.h"

#include <algorithm>

#include "saca/core/contract.h"
#include "saca/core/parallel.h"
#include "saca/outcome/ordering.h"

namespace saca::eval {
namespace {

using manoeuvre::num_policies;
using manoeuvre::PolicyId;
using Tried = std::array<outcome::Outcome, num_policies>;  // meaningless where refused

Tried outcomes_of(const loop::Hindsights& tried) {
  Tried outcomes;
  std::transform(tried.begin(), tried.end(), outcomes.begin(), [](const loop::Hindsight& one) {
    return one.facts.drivable() ? one.facts.outcome() : outcome::Outcome{};
  });
  return outcomes;
}

/// All worlds. What can be driven is the same in all: the ego believes in the same start.
std::vector<Tried> all_draws(const sim::Scenario& scenario, const manoeuvre::Car& car,
                             const outcome::HarmModel& harm, const OracleOptions& options) {
  constexpr std::size_t at_once = 32;  // else thousands of motions would be kept
  const auto num_draws = static_cast<std::size_t>(options.draws);
  std::vector<Tried> draws;
  draws.reserve(num_draws);
  while (draws.size() < num_draws) {
    std::vector<Moment> moments(std::min(at_once, num_draws - draws.size()));
    in_parallel(moments.size(), options.threads, [&](std::size_t k) {
      const sim::Chance chance = sim::draw_chance(options.seed, draws.size() + k, options.time);
      moments[k] = moment_at(scenario, car, options.time, chance);
    });
    for (const loop::Hindsights& tried : hindsights(moments, car, harm, options.threads)) {
      draws.push_back(outcomes_of(tried));
    }
  }
  return draws;
}

/// What is sure: one outcome, without an interval.
outcome::Expected sure(const outcome::Outcome& outcome) {
  const double hit = outcome.contact ? 1.0 : 0.0;
  return {
      .harm = {outcome.harm, outcome.harm, outcome.harm},
      .collision_loss = {outcome.collision_loss, outcome.collision_loss, outcome.collision_loss},
      .contact = {hit, hit, hit}};
}

/// For the one ordering: mean harm and mean clearance.
outcome::Outcome on_average(const std::vector<outcome::Outcome>& outcomes) {
  outcome::Outcome mean;
  mean.clearance = 0.0;
  for (const outcome::Outcome& outcome : outcomes) {
    mean.harm += outcome.harm / static_cast<double>(outcomes.size());
    mean.clearance += outcome.clearance / static_cast<double>(outcomes.size());
  }
  return mean;
}

}  // namespace

Oracle oracle(const sim::Scenario& scenario, const manoeuvre::Car& car,
              const outcome::HarmModel& harm, const OracleOptions& options) {
  expects(options.draws == 0 || options.draws >= 2, "draws is 0, or 2 at least");
  expects(options.threads >= 1, "threads >= 1");
  Oracle told;
  const Moment moment = moment_at(scenario, car, options.time);
  told.scene = moment.scene;
  const loop::Hindsights written = hindsight(moment, car, harm);
  const Tried as_written = outcomes_of(written);
  const std::vector<Tried> draws = all_draws(scenario, car, harm, options);
  std::array<std::vector<outcome::Outcome>, num_policies> outcomes;
  std::array<outcome::Outcome, num_policies> average;
  for (std::size_t i = 0; i < num_policies; ++i) {
    told.verdicts[i].written = written[i];
    if (!written[i].facts.drivable()) {
      continue;
    }
    for (const Tried& draw : draws) {
      outcomes[i].push_back(draw[i]);
    }
    told.verdicts[i].expected =
        draws.empty() ? sure(as_written[i]) : outcome::expected(outcomes[i]);
    average[i] = draws.empty() ? as_written[i] : on_average(outcomes[i]);
    told.ranking.push_back(manoeuvre::all_policies[i]);
  }
  std::sort(told.ranking.begin(), told.ranking.end(), [&](PolicyId a, PolicyId b) {
    return outcome::better(average[manoeuvre::index(a)], a, average[manoeuvre::index(b)], b);
  });
  const std::size_t best = manoeuvre::index(told.best());
  for (const PolicyId policy : told.ranking) {
    const std::size_t i = manoeuvre::index(policy);
    const double more = average[i].harm - average[best].harm;
    told.verdicts[i].behind = draws.empty() ? outcome::Mean{more, more, more}
                                            : outcome::harm_difference(outcomes[i], outcomes[best]);
  }
  return told;
}

Margin margin_of_best(const Oracle& oracle) {
  std::optional<Margin> least;
  for (const PolicyId policy : oracle.ranking) {
    const outcome::Mean& behind = oracle.of(policy).behind;
    if (policy != oracle.best() && (!least || behind.value < least->mean)) {
      least = Margin{behind.value, behind.low};
    }
  }
  return least.value_or(Margin{});
}

}  // namespace saca::eval
