#include "saca/thinking/arbitration/check.h"

#include <fmt/core.h>

#include <array>
#include <span>

#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/preview/drawn_motions.h"

namespace saca::arbitration {
namespace {

using manoeuvre::PolicyId;

std::string expectation(const preview::ExpectedHarm& one) {
  return fmt::format("expected harm {:.4f}, contact {:.0f} %", one.harm, 100.0 * one.contact);
}

}  // namespace

Check check(const preview::ExpectedHarm& plan, const preview::ExpectedHarm& aeb) {
  const std::string name = plan_text(plan.plan);
  if (!plan.refusal.empty()) {
    return {false, name + ": cannot be driven: " + plan.refusal};
  }
  const std::string line = name + ": " + expectation(plan);
  const bool brakes = plan.plan.policy == PolicyId::aeb;
  if (!brakes &&
      collision::better({.harm = aeb.harm}, PolicyId::aeb, {.harm = plan.harm}, plan.plan.policy)) {
    return {false, line + "; braking does no more harm: " + expectation(aeb)};
  }
  return {true, line};
}

Check check(const manoeuvre::Plan& plan, const preview::Situation& situation,
            const preview::ForecastTools& tools) {
  const std::array plans{plan, manoeuvre::full_braking};
  const std::size_t needed = plan.policy == PolicyId::aeb ? 1 : 2;
  const auto expected = preview::expected_harms(
      situation.scene_at_trigger, preview::drawn_motions(situation, usual_draws), tools,
      preview::Physics::rolled_out, std::span(plans).first(needed));
  return check(expected.front(), expected.back());
}

Check check_unfounded(PolicyId chosen, const preview::Situation& situation) {
  const world::Scene& scene = situation.scene_at_trigger;
  const PolicyId best = preview::best_by_forecast(situation.facts);
  const std::string line =
      language_model::policy_line(situation.facts[manoeuvre::index(chosen)], scene);
  if (chosen == best) {
    return {true, line + "; the reasons are false, yet nothing is forecast better"};
  }
  return {false, line + "; the reasons are false, and better is forecast: " +
                     language_model::policy_line(situation.facts[manoeuvre::index(best)], scene)};
}

}  // namespace saca::arbitration
