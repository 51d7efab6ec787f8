#include "saca/lab/model_trials/forecast_reply.h"

#include <string>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::model_trials {

using arbitration::Preview;
using language_model::Reply;

Result<std::vector<Reply>> replies_about(const std::vector<Preview>& previews,
                                         language_model::LanguageModel& model, Clock::Time patience,
                                         const Clock& clock, const TextListener& listener) {
  language_model::Question question;
  for (const Preview& preview : previews) {
    question.scenes.push_back(preview.prompt);
    question.grammars.push_back(arbitration::grammar_of(preview));
  }
  const Clock::Time begin = clock.now();
  auto replies = model.ask(question.scenes, begin + patience,
                           [&](const language_model::Progress& news) {
                             if (!news.text.empty()) {
                               listener(news.prompt, news.text);
                             }
                           },
                           {.grammars = question.grammars});
  if (!replies.has_value()) {
    return replies.error();
  }
  std::vector<Reply> dated = std::move(replies).value();
  for (Reply& reply : dated) {
    for (language_model::Answer& answer : reply.answers) {
      answer.time -= begin;
    }
  }
  return dated;
}

std::vector<ForecastReply> considered(const std::vector<Preview>& previews, std::vector<Reply> said,
                                      const preview::ForecastTools& tools,
                                      language_model::LanguageModel& model, const Clock& clock) {
  expects(said.size() == previews.size(), "a reply for each preview");
  std::vector<ForecastReply> all;
  all.reserve(said.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    ForecastReply one{.preview = &previews[i], .reply = std::move(said[i])};
    const preview::Situation& situation = one.preview->situation;
    if (!one.reply.answers.empty()) {
      const manoeuvre::PolicyId chosen = likeliest_policy(one.reply.answers.back());
      one.check =
          arbitration::check(situation.facts[manoeuvre::index(chosen)].plan, situation, tools);
    }
    one.truth = language_model::truth_of(one.reply, one.preview->prompt, situation);
    Preview replied = *one.preview;
    replied.reply = one.reply;
    one.explanation = arbitration::retold(replied, model, clock);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace saca::model_trials
