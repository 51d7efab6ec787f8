#include "saca/loop/review.h"

#include <chrono>
#include <utility>

namespace saca::loop {

Result<std::optional<reason::Review>> review(const Setup& setup, const Record& record,
                                             const std::function<void(std::string_view)>& on_text) {
  if (setup.model == nullptr || !record.decision || !record.hindsight || !record.best) {
    return std::optional<reason::Review>();
  }
  reason::Aftermath aftermath{.done = record.decision->plan,
                              .result = record.result,
                              .met = record.met,
                              .best = *record.best};
  aftermath.known.scene_at_trigger = *record.at_trigger;
  for (std::size_t k = 0; k < manoeuvre::num_policies; ++k) {
    aftermath.known.facts[k] = (*record.hindsight)[k].facts;
  }
  if (record.decision->forecast) {
    aftermath.forecast_harm = record.decision->forecast->plan;
  }
  reason::Review review{.prompt = reason::review_prompt(aftermath)};
  constexpr auto patience = std::chrono::minutes(10);
  const auto replies = setup.model->ask({review.prompt}, setup.clock->now() + patience,
                                        [&](const reason::Progress& news) {
                                          if (!news.text.empty()) {
                                            on_text(news.text);
                                          }
                                        });
  if (!replies.has_value()) {
    return replies.error();
  }
  review.text = replies.value().front().reasoning;
  review.truth = reason::truth_of(review.text, review.prompt, aftermath.known, std::nullopt);
  return std::optional(std::move(review));
}

}  // namespace saca::loop
