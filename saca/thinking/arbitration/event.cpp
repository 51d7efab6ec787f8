#include "saca/thinking/arbitration/event.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "saca/base/core/names.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/reply_grammar.h"
#include "saca/thinking/language_model/retelling.h"

namespace saca::arbitration {
namespace {

constexpr std::array<std::string_view, 3> plane_names{"world", "reflex", "thinking"};
constexpr std::array<std::string_view, 17> kind_names{
    "preview",      "risk",   "intention", "forecast", "memory",  "ask",
    "first_answer", "answer", "check",     "cached",   "trigger", "match",
    "execute",      "switch", "contact",   "rest",     "fault"};

/// What the verdict says of a plan, beside braking.
std::string told(const reflex::Verdict& verdict, const manoeuvre::Plan& plan) {
  std::string text;
  for (const manoeuvre::Plan& one : {plan, manoeuvre::full_braking}) {
    const reflex::JudgedPlan* const judged = reflex::find_plan(verdict, one);
    if (judged != nullptr && (text.empty() || one != plan)) {
      text += fmt::format("{}{} {:.4f}", text.empty() ? "" : ", ", plan_text(one), judged->harm);
    }
  }
  return text;
}

/// What the model was asked, or would be.
std::string asked_prompt(const Preview& preview) {
  return preview.prompt.empty() ? prompt_of(preview) : preview.prompt;
}

/// Nothing is explained where there is none, or it cannot be driven.
std::optional<manoeuvre::PolicyId> explained_policy(const Preview& preview) {
  std::optional<manoeuvre::PolicyId> chosen;
  if (preview.plan) {
    chosen = preview.plan->policy;
  } else if (!preview.reply.answers.empty()) {
    chosen = language_model::likeliest_policy(preview.reply.answers.back());
  }
  return chosen && preview.situation.facts[manoeuvre::index(*chosen)].drivable() ? chosen
                                                                                 : std::nullopt;
}

/// @param written  whole sentences of a reply
language_model::Explanation explanation_by(std::string_view written, const Preview& preview,
                                           manoeuvre::PolicyId chosen) {
  return language_model::explanation(written, asked_prompt(preview), preview.situation,
                                     told_case(preview), chosen);
}

}  // namespace

std::string_view name(Plane plane) {
  return name_of(plane, plane_names);
}

std::string_view name(EventKind kind) {
  return name_of(kind, kind_names);
}

const Preview* find_preview(std::span<const Preview> previews, std::int32_t number) noexcept {
  const auto found =
      std::lower_bound(previews.begin(), previews.end(), number,
                       [](const Preview& one, std::int32_t wanted) { return one.number < wanted; });
  return found == previews.end() || found->number != number ? nullptr : &*found;
}

std::optional<memory::Case> told_case(const Preview& preview) {
  return preview.nearest ? std::optional(preview.nearest->found) : std::nullopt;
}

std::string prompt_of(const Preview& preview) {
  return language_model::scene_part(preview.situation, told_case(preview),
                                    preview.nearest ? preview.nearest->similarity : 0.0);
}

std::string grammar_of(const Preview& preview, const std::optional<manoeuvre::PolicyId>& choice) {
  return language_model::reply_grammar(preview.situation, asked_prompt(preview), told_case(preview),
                                       choice);
}

std::optional<language_model::Explanation> explanation(const Preview& preview) {
  if (preview.retold) {
    return preview.retold;
  }
  const auto chosen = explained_policy(preview);
  return chosen ? std::optional(explanation_by(language_model::finished_part(preview.reply),
                                               preview, *chosen))
                : std::nullopt;
}

std::optional<language_model::Explanation> retold(const Preview& preview,
                                                  language_model::LanguageModel& model,
                                                  const Clock& clock, const std::stop_token& stop) {
  auto first = explanation(preview);
  const auto chosen = explained_policy(preview);
  if (!first || first->from != language_model::Explanation::From::facts || !chosen ||
      preview.reply.answers.empty()) {
    return first;
  }
  const auto again = language_model::told_again(
      model, clock, asked_prompt(preview), *first,
      [&](std::string_view written) { return explanation_by(written, preview, *chosen); },
      {.stop = stop, .grammars = {grammar_of(preview, *chosen)}});
  return again.has_value() ? std::optional(again.value()) : first;
}

std::string trigger_text(const world::Actor& actor, double time,
                         const std::optional<double>& waiting_cost) {
  const std::string conflict =
      fmt::format("{:.2f} s to the conflict with {}", time, actor_name(actor));
  return waiting_cost
             ? fmt::format("before T1, {}: to wait for {:g} s is expected to harm {:.4f} more",
                           conflict, reflex::waited, *waiting_cost)
             : "T1: " + conflict;
}

std::string decision_text(const reflex::Decision& decision) {
  if (decision.source == reflex::Source::forced) {
    return "asked for by the user";
  }
  std::string refused =
      decision.refused ? fmt::format("{} cannot be driven from here ({}): emergency braking",
                                     plan_text(decision.refused->plan), name(decision.refused->why))
                       : "";
  if (decision.refused && !decision.similarity && !decision.verdict) {
    return refused;  // asked for by the user
  }
  std::string text = decision.similarity
                         ? fmt::format("the scene is {:.0f} % like forecast {}",
                                       100.0 * *decision.similarity, *decision.preview + 1)
                         : "no plan is cached";
  if (decision.source == reflex::Source::memory || decision.source == reflex::Source::model) {
    return text + fmt::format(": its plan, from {}, is taken", name(decision.source));
  }
  if (decision.not_admissible) {
    text += ", whose plan would do too much harm from here";
  } else if (reflex::was_needless(decision)) {
    text += ", whose plan is not begun, for doing nothing is as good";
  } else if (decision.similarity) {
    text += ", not more than 90 %";
  }
  if (decision.refused) {
    return text + "; " + refused;
  }
  if (!decision.verdict) {
    return text + "; nothing can be judged: emergency braking";
  }
  return text + fmt::format("; expected harm{}: {}; {} of {} plans are admissible",
                            decision.by_atlas ? " by the atlas" : "",
                            told(*decision.verdict, decision.plan),
                            reflex::num_admissible(*decision.verdict),
                            decision.verdict->plans.size());
}

std::string execution_text(const manoeuvre::Plan& plan, reflex::Source source) {
  return fmt::format("policy {} ({})", plan_text(plan), name(source));
}

std::string switch_text(const reflex::Switch& change) {
  switch (change.reason) {
    case reflex::SwitchReason::needed_after_all:
      return fmt::format("doing nothing is expected to harm {:.4f} now: {}, {:.4f}",
                         change.harm_before, plan_text(change.plan), change.harm);
    case reflex::SwitchReason::cannot_be_judged:
      return "neither forecaster nor atlas can say what is best: " + plan_text(change.plan);
    case reflex::SwitchReason::no_longer_needed:
      return "nobody is in the way any more: lane and speed are kept";
    case reflex::SwitchReason::harder_needed:
    case reflex::SwitchReason::better_by_far:
      break;
  }
  return fmt::format("going on is expected to harm {:.4f}, {} from here {:.4f}", change.harm_before,
                     plan_text(change.plan), change.harm);
}

Event events_not_told(double time, Plane plane, std::size_t count) {
  return {
      time, plane, EventKind::fault,
      fmt::format("{} events or pieces of reasoning were not told: whoever listens was too slow",
                  count)};
}

}  // namespace saca::arbitration
