#include "saca/lab/encounter/thinking_figures.h"

#include <algorithm>

namespace saca::encounter {
namespace {

using arbitration::Preview;

bool is_answered(const Preview& preview) {
  return !preview.reply.answers.empty();
}

/// Why nothing was in the cache at the trigger.
std::string why_nothing_is_cached(std::span<const Preview> previews) {
  const auto any = [&](const auto& holds) {
    return std::any_of(previews.begin(), previews.end(), holds);
  };
  if (previews.empty()) {
    return "nothing was forecast before T1";
  }
  if (any([](const Preview& one) { return one.plan.has_value(); })) {
    return "the plan was not ready at T1";
  }
  if (any([](const Preview& one) { return one.check && !one.check->passed; })) {
    return "what was proposed did not pass its check";
  }
  if (any([](const Preview& one) { return one.unheard; })) {
    return "the model gave no answer in time";
  }
  if (any([](const Preview& one) { return one.nearest && one.gate == memory::Gate::reason; })) {
    return "no case in memory is alike";
  }
  return "no plan is cached";
}

std::optional<ExpectedAtDecision> expected_at(const reflex::Decision& decision) {
  if (!decision.verdict) {
    return std::nullopt;
  }
  const reflex::JudgedPlan* const plan = find_plan(*decision.verdict, decision.plan);
  const reflex::JudgedPlan* const braking = find_plan(*decision.verdict, manoeuvre::full_braking);
  if (plan == nullptr || !plan->drivable || braking == nullptr || !braking->drivable) {
    return std::nullopt;
  }
  return ExpectedAtDecision{decision.time, decision.plan, plan->harm, braking->harm,
                            static_cast<int>(num_admissible(*decision.verdict))};
}

}  // namespace

ThinkingFigures thinking_figures(std::span<const Preview> previews,
                                 const std::optional<reflex::Decision>& decision) {
  const auto count = [&](const auto& holds) {
    return static_cast<int>(std::count_if(previews.begin(), previews.end(), holds));
  };
  const auto plan_from = [](reflex::Source source) {
    return [source](const Preview& one) { return one.plan && one.source == source; };
  };
  ThinkingFigures figures{
      .forecasts = static_cast<int>(previews.size()),
      .recalled =
          count([](const Preview& one) { return one.nearest && one.gate != memory::Gate::reason; }),
      .from_memory = count(plan_from(reflex::Source::memory)),
      .from_model = count(plan_from(reflex::Source::model)),
      .asked = count([](const Preview& one) { return is_answered(one) || one.unheard; }),
      .answered = count(is_answered),
      .ended = count([](const Preview& one) {
        return is_answered(one) &&
               one.reply.answers.back().kind == language_model::Answer::Kind::ended;
      }),
      .unfounded =
          count([](const Preview& one) { return one.truth && one.truth->is_choice_unfounded(); })};
  for (const Preview& one : previews) {
    figures.statements += one.truth ? one.truth->num_checked : 0;
    figures.false_statements += one.truth ? static_cast<int>(one.truth->wrong.size()) : 0;
  }
  figures.expected = decision ? expected_at(*decision) : std::nullopt;
  if (decision && decision->preview) {
    const Preview* const most_alike = arbitration::find_preview(previews, *decision->preview);
    if (most_alike != nullptr && is_answered(*most_alike)) {
      figures.answer = most_alike->reply.answers.back().probability;
    }
  }
  return figures;
}

std::string reason_of(const reflex::Decision& decision, std::span<const Preview> previews) {
  if (decision.source == reflex::Source::memory || decision.source == reflex::Source::model) {
    return "a cached plan matches";
  }
  if (decision.refused) {
    return "what was decided on cannot be driven";
  }
  if (!decision.similarity) {
    return why_nothing_is_cached(previews);
  }
  return decision.not_admissible          ? "the plan that matches is not admissible"
         : reflex::was_needless(decision) ? "doing nothing is as good as the plan that matches"
                                          : "no cached plan matches above 90 %";
}

}  // namespace saca::encounter
