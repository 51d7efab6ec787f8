#include "saca/lab/encounter/review.h"

#include <chrono>
#include <utility>

#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/retelling.h"

namespace saca::encounter {
namespace {

constexpr auto review_patience = std::chrono::minutes(2);
constexpr int review_tokens = 256;  // three statements with their figures are about 130

/// @param record  of an encounter that was decided, and judged afterwards
language_model::Aftermath aftermath_of(const Record& record) {
  language_model::Aftermath aftermath{.done = record.decision->plan,
                                      .result = record.result,
                                      .met = record.met,
                                      .best = *record.best};
  for (const TimedSwitch& each : record.switches) {
    aftermath.later.push_back(each.change.plan);
  }
  aftermath.known.scene_at_trigger = *record.at_trigger;
  for (std::size_t k = 0; k < manoeuvre::num_policies; ++k) {
    aftermath.known.facts[k] = (*record.hindsight)[k].facts;
  }
  if (record.decision->verdict) {
    const auto* const judged = find_plan(*record.decision->verdict, record.decision->plan);
    aftermath.forecast_harm = judged == nullptr ? std::nullopt : std::optional(judged->harm);
  }
  return aftermath;
}

}  // namespace

Result<std::optional<language_model::Review>> review(
    const Setup& setup, const Record& record, const std::function<void(std::string_view)>& on_text,
    const std::stop_token& stop) {
  if (setup.model == nullptr || !record.decision || !record.hindsight || !record.best) {
    return std::optional<language_model::Review>();
  }
  const language_model::Aftermath aftermath = aftermath_of(record);
  language_model::Review review{.prompt = language_model::review_prompt(aftermath)};
  const auto hear = [&](const language_model::Progress& news) {
    if (!news.text.empty()) {
      on_text(news.text);
    }
  };
  const language_model::AskOptions options{.stop = stop,
                                           .max_tokens = review_tokens,
                                           .grammars = {language_model::review_grammar(aftermath)}};
  const auto replies =
      setup.model->ask({review.prompt}, setup.clock->now() + review_patience, hear, options);
  if (!replies.has_value()) {
    return replies.error();
  }
  if (stop.stop_requested()) {
    return Error{Error::Code::too_late, "it was withdrawn"};
  }
  review.text = replies.value().front().reasoning;
  const std::string_view written = language_model::finished_part(replies.value().front());
  review.truth = language_model::truth_of(written, review.prompt, aftermath.known, std::nullopt);
  const auto shown_by = [&](std::string_view text) {
    return language_model::explanation({.prompt = review.prompt, .text = std::string(text)},
                                       aftermath);
  };
  review.shown = shown_by(written);
  const auto again = language_model::told_again(*setup.model, *setup.clock, review.prompt,
                                                review.shown, shown_by, options);
  if (again.has_value()) {
    review.shown = again.value();
  }
  return std::optional(std::move(review));
}

}  // namespace saca::encounter
