#include "saca/reason/review.h"

#include <fmt/core.h>

#include "saca/outcome/describe.h"
#include "saca/reason/prompt.h"

namespace saca::reason {

std::string review_prompt(const Aftermath& aftermath) {
  const auto& facts = aftermath.known.facts;
  const preview::PolicyFacts& best = facts[manoeuvre::index(aftermath.best)];
  std::string text =
      "# Review of an encounter that is over\n"
      "Say in three short numbered statements what happened, which policy would have been best and "
      "by how much, and what to remember. Quote the figures. As the last line name the policy that "
      "would have been best: \"Response to user: N\".\n"
      "## Carried Out:\n";
  text += manoeuvre::plan_text(aftermath.done);
  for (const manoeuvre::Plan& plan : aftermath.later) {
    text += ", then " + manoeuvre::plan_text(plan);
  }
  text += ": " + outcome::describe(aftermath.result, aftermath.met) + ", " +
          harm_text(aftermath.result.harm);
  if (aftermath.forecast_harm && aftermath.later.empty()) {
    text += "; forecast was " + harm_text(*aftermath.forecast_harm);
  }
  text += "\n## What each policy leads to, as is known now:\n";
  for (const preview::PolicyFacts& each : facts) {
    text += each.drivable() ? policy_line(each, aftermath.known.scene_at_trigger) + '\n'
                            : manoeuvre::plan_text(each.plan) + ": not possible\n";
  }
  text += "## Best in Hindsight:\n" + manoeuvre::plan_text(best.plan);
  return text + (aftermath.best == aftermath.done.policy && aftermath.later.empty()
                     ? ": what was carried out\n"
                     : fmt::format(": harm less by {:.4f}\n",
                                   aftermath.result.harm - best.outcome().harm));
}

}  // namespace saca::reason
