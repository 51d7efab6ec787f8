#include "saca/lab/model_trials/question_timing.h"

#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::model_trials {

using language_model::Answer;
using language_model::Reply;

std::vector<std::string> example_scenes() {
  std::vector<std::string> scenes;
  for (const double speed : {7.5, 5.0, 2.5}) {
    preview::Situation situation = language_model::example_situation();
    situation.scene_at_trigger.actors[0].v_W.y = -speed;
    situation.facts[1].outcome().contact->relative_speed += speed;
    scenes.push_back(language_model::scene_part(situation, std::nullopt, 0.0));
  }
  return scenes;
}

QuestionTiming timed_question(language_model::LanguageModel& model,
                              const std::vector<std::string>& scenes, double budget,
                              const Clock& clock) {
  QuestionTiming asked;
  std::vector<bool> answered(scenes.size());
  const Clock::Time begin = clock.now();
  const auto replies = model.ask(scenes, begin + from_seconds(budget),
                                 [&](const language_model::Progress& progress) {
                                   if (progress.answer != nullptr && !answered[progress.prompt]) {
                                     answered[progress.prompt] = true;
                                     asked.first = to_seconds(clock.now() - begin);
                                   }
                                 });
  asked.whole = to_seconds(clock.now() - begin);
  asked.missing = static_cast<int>(scenes.size());
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
