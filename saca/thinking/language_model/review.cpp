#include "saca/thinking/language_model/review.h"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/gbnf.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::language_model {
namespace {

/// Nothing else was carried out, and nothing would have been better.
bool was_best(const Aftermath& aftermath) {
  return aftermath.best == aftermath.done.policy && aftermath.later.empty();
}

/// "hits car1 with its front at 4.2 m/s, harm 0.0125".
std::string result_text(const Aftermath& aftermath) {
  return rollout::describe(aftermath.result, aftermath.met) + ", " +
         harm_text(aftermath.result.harm);
}

/// Harm of what was done above that of the best.
double harm_above_best(const Aftermath& aftermath) {
  const preview::PolicyFacts& best = aftermath.known.facts[manoeuvre::index(aftermath.best)];
  return aftermath.result.harm - best.outcome().harm;
}

/// Of what was carried out to the end; nullopt: nothing was forecast of it.
std::optional<double> forecast_of(const Aftermath& aftermath) {
  return aftermath.later.empty() ? aftermath.forecast_harm : std::nullopt;
}

}  // namespace

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
  text += ": " + result_text(aftermath);
  if (const auto forecast = forecast_of(aftermath)) {
    text += "; forecast was " + harm_text(*forecast);
  }
  text += "\n## What each policy leads to, as is known now:\n";
  for (const preview::PolicyFacts& each : facts) {
    text += each.drivable() ? policy_line(each, aftermath.known.scene_at_trigger) + '\n'
                            : manoeuvre::plan_text(each.plan) + ": not possible\n";
  }
  text += "## Best in Hindsight:\n" + manoeuvre::plan_text(best.plan);
  return text + (was_best(aftermath)
                     ? ": what was carried out\n"
                     : fmt::format(": harm less by {:.4f}\n", harm_above_best(aftermath)));
}

std::string review_grammar(const Aftermath& aftermath) {
  const auto& facts = aftermath.known.facts;
  const std::string happened = gbnf::literal("It came to this: " + result_text(aftermath));
  std::vector<std::string> lessons;
  for (const preview::PolicyFacts& each : facts) {
    if (each.drivable() && each.plan.policy != aftermath.done.policy) {
      const std::string line = policy_line(each, aftermath.known.scene_at_trigger);
      lessons.push_back(gbnf::literal("To remember:" + line.substr(line.find(' '))));  // no number
    }
  }
  const auto forecast = forecast_of(aftermath);
  if (forecast && std::abs(aftermath.result.harm - *forecast) > memory::as_good) {
    lessons.push_back(
        gbnf::literal(fmt::format("It harmed {} than was forecast: {} instead of {}",
                                  aftermath.result.harm > *forecast ? "more" : "less",
                                  harm_text(aftermath.result.harm), harm_text(*forecast))));
  }
  const double less = harm_above_best(aftermath);
  const std::string best =
      gbnf::literal(fmt::format("So {}: least harm", name(aftermath.best))) + ' ' +
      gbnf::perhaps(was_best(aftermath) || less < collision::harm_tie
                        ? std::vector<std::string>()
                        : gbnf::literals({fmt::format(", harm less by {:.4f}", less)}));
  const std::string second =
      lessons.empty() ? R"("2. " best)"
                      : fmt::format(R"("2. " (best | {} ".\n3. " best))", gbnf::one_of(lessons));
  return fmt::format(
      "root ::= \"Scenario Analysis\\n1. \" {} \".\\n\" {} \".\\nResponse to user:\"\nbest ::= "
      "{}\n",
      happened, second, best);
}

Explanation explanation(const Review& review, const Aftermath& aftermath) {
  if (auto held = true_part(review.text, review.prompt, aftermath.known, std::nullopt)) {
    return *std::move(held);
  }
  const preview::PolicyFacts& best = aftermath.known.facts[manoeuvre::index(aftermath.best)];
  const double more = harm_above_best(aftermath);
  std::string text = fmt::format("1. {} was carried out", manoeuvre::plan_name(aftermath.done));
  for (const manoeuvre::Plan& plan : aftermath.later) {
    text += ", then " + manoeuvre::plan_name(plan);
  }
  text += ": " + result_text(aftermath) + ".\n";
  if (was_best(aftermath)) {
    text += "2. Nothing would have harmed less.\n";
  } else if (more >= collision::harm_tie) {
    text += fmt::format("2. {} would have harmed less by {:.4f}.\n",
                        manoeuvre::plan_name(best.plan), more);
  } else {
    text += fmt::format("2. {} would have harmed as much.\n", manoeuvre::plan_name(best.plan));
  }
  if (const auto forecast = forecast_of(aftermath)) {
    const double error = aftermath.result.harm - *forecast;
    text += std::abs(error) <= memory::as_good
                ? "3. It went as forecast"
                : fmt::format("3. It harmed {:.4f} {} than was forecast", std::abs(error),
                              error > 0.0 ? "more" : "less");
    text += fmt::format(": {} instead of {}.\n", harm_text(aftermath.result.harm),
                        harm_text(*forecast));
  }
  return {text, Explanation::From::facts};
}

}  // namespace saca::language_model
