#include "saca/lab/eval/trigger_case.h"

#include <utility>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/yardstick.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::eval {
namespace {

memory::Case case_now(const encounter::ClosedLoop& now, const encounter::Stage& stage,
                      const preview::ForecastTools& tools, std::size_t draws,
                      const std::vector<memory::MadeWith>& made_with) {
  const auto tried = try_all(now, *stage.car, *stage.harm, Knowledge::everything);
  const preview::PolicyFacts& best = tried[best_of(tried)].facts;
  const collision::Outcome& outcome = best.outcome();
  memory::Case one = encounter::case_of(now.seen(), now.beliefs(), *stage.scenario);
  one.plan = best.plan;
  one.best = best.plan.policy;
  one.harm = outcome.harm;
  one.best_harm = outcome.harm;
  one.collision_loss = outcome.collision_loss;
  one.told = encounter::forecast_harms(
      arbitration::Forecaster(tools, draws).judge(now.seen(), now.beliefs()));
  one.happened = encounter::happened_harms(tried);
  one.made_with = made_with;
  return one;
}

}  // namespace

Result<std::optional<encounter::ClosedLoop>> played_to_trigger(const encounter::Stage& stage) {
  encounter::ClosedLoop now(stage);
  while (!now.over()) {
    if (auto problem = now.look()) {
      return *std::move(problem);
    }
    (void)now.wake();
    if (now.driven() && now.trigger()) {
      return std::optional(std::move(now));
    }
    now.keep();
    if (now.contact()) {
      break;
    }
    now.advance();
  }
  return std::optional<encounter::ClosedLoop>();
}

Result<std::optional<memory::Case>> case_at_trigger(
    const encounter::Stage& stage, const preview::ForecastTools& tools, std::size_t draws,
    const std::vector<memory::MadeWith>& made_with) {
  const auto now = played_to_trigger(stage);
  if (!now.has_value()) {
    return now.error();
  }
  return now.value() ? std::optional(case_now(*now.value(), stage, tools, draws, made_with))
                     : std::nullopt;
}

}  // namespace saca::eval
