#include "saca/eval/trigger_case.h"

#include <utility>

#include "saca/decide/forecaster.h"
#include "saca/eval/yardstick.h"
#include "saca/loop/learnt_case.h"

namespace saca::eval {
namespace {

memory::Case case_now(const loop::ClosedLoop& now, const loop::Stage& stage,
                      const preview::ForecastTools& tools, std::size_t draws) {
  const auto tried = try_all(now, *stage.car, *stage.harm, Knowledge::everything);
  const preview::PolicyFacts& best = tried[best_of(tried)].facts;
  const outcome::Outcome& outcome = best.outcome();
  memory::Case one{
      .scene = now.seen(),
      .plan = best.plan,
      .best = best.plan.policy,
      .harm = outcome.harm,
      .best_harm = outcome.harm,
      .collision_loss = outcome.collision_loss,
      .source = stage.scenario->name,
      .origin = stage.scenario->provenance ? memory::Origin::recording : memory::Origin::simulation,
      .told = loop::told_harms(decide::Forecaster(tools, draws).judge(now.seen(), now.beliefs())),
      .happened = loop::happened_harms(tried),
      .made_with = loop::made_with(tools, *stage.intent, stage.scenario->car)};
  for (const intent::Belief& belief : now.beliefs()) {
    one.intentions.push_back(belief.now());
  }
  return one;
}

}  // namespace

Result<std::optional<memory::Case>> case_at_trigger(const loop::Stage& stage,
                                                    const preview::ForecastTools& tools,
                                                    std::size_t draws) {
  loop::ClosedLoop now(stage);
  while (!now.over()) {
    if (auto problem = now.look()) {
      return *std::move(problem);
    }
    (void)now.wake();
    if (now.driven() && now.trigger()) {
      return std::optional(case_now(now, stage, tools, draws));
    }
    now.keep();
    if (now.contact()) {
      break;
    }
    now.advance();
  }
  return std::optional<memory::Case>();
}

}  // namespace saca::eval
