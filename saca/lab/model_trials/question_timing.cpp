#include "saca/lab/model_trials/question_timing.h"

#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply_grammar.h"

namespace saca::model_trials {

using language_model::Answer;
using language_model::Reply;

language_model::Question example_question() {
  language_model::Question question;
  for (const double speed : {7.5, 5.0, 2.5}) {
    preview::Situation situation = language_model::example_situation();
    situation.scene_at_trigger.actors[0].v_W.y = -speed;
    situation.facts[1].outcome().contact->relative_speed += speed;
    const std::string scene = language_model::scene_part(situation, std::nullopt, 0.0);
    question.scenes.push_back(scene);
    question.grammars.push_back(language_model::reply_grammar(situation, scene, std::nullopt));
  }
  return question;
}

QuestionTiming timed_question(language_model::LanguageModel& model,
                              const language_model::Question& question, double budget,
                              const Clock& clock) {
  QuestionTiming asked;
  std::vector<bool> answered(question.scenes.size());
  const Clock::Time begin = clock.now();
  const auto replies = model.ask(question.scenes, begin + from_seconds(budget),
                                 [&](const language_model::Progress& progress) {
                                   if (progress.answer != nullptr && !answered[progress.prompt]) {
                                     answered[progress.prompt] = true;
                                     asked.first = to_seconds(clock.now() - begin);
                                   }
                                 },
                                 {.grammars = question.grammars});
  asked.whole = to_seconds(clock.now() - begin);
  asked.missing = static_cast<int>(question.scenes.size());
  if (!replies.has_value()) {
    asked.error = replies.error();
    return asked;
  }
  asked.replies = replies.value();
  for (const Reply& reply : asked.replies) {
    asked.missing -= reply.answers.empty() ? 0 : 1;
    const bool forced = !reply.answers.empty() && reply.answers.back().kind == Answer::Kind::forced;
    asked.forced += forced ? 1 : 0;
  }
  if (const auto* const child = dynamic_cast<const language_model::ChildModel*>(&model)) {
    asked.figures = child->figures();
  }
  return asked;
}

}  // namespace saca::model_trials
