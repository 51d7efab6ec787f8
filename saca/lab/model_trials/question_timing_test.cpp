#include "saca/lab/model_trials/question_timing.h"

#include <gmock/gmock.h>

#include <chrono>

#include "saca/thinking/language_model/scripted_model.h"

namespace saca::model_trials::question_timing_test {
namespace {

using language_model::Answer;
using language_model::ScriptedModel;
using language_model::ScriptedReply;
using manoeuvre::PolicyId;
using std::chrono::milliseconds;
using testing::HasSubstr;

TEST(QuestionTimingTest, ExamplesDifferAsPreviewsDo) {
  const language_model::Question question = example_question();
  const std::vector<std::string>& scenes = question.scenes;
  ASSERT_EQ(scenes.size(), 3U);
  ASSERT_EQ(question.grammars.size(), 3U);
  EXPECT_THAT(question.grammars[1], HasSubstr("truck1"));
  EXPECT_THAT(scenes[0], HasSubstr("7.5 m/s"));
  EXPECT_THAT(scenes[1], HasSubstr("5.0 m/s"));
  EXPECT_NE(scenes[1], scenes[2]);
}

TEST(QuestionTimingTest, TakesTheTimeOfTheFirstAnswersAndOfAll) {
  ManualClock clock;
  clock.set(milliseconds(5'000));
  const auto script = [](const std::string& scene) {
    const milliseconds first(scene == "a" ? 100 : 250);
    return ScriptedReply{
        .lines = {{.after = first, .answer = Answer::Kind::first, .policy = PolicyId::aeb},
                  {.after = milliseconds(500),
                   .text = "so",
                   .answer = scene == "a" ? Answer::Kind::ended : Answer::Kind::forced,
                   .policy = PolicyId::aeb}}};
  };
  ScriptedModel model(script, clock);
  const QuestionTiming asked =
      timed_question(model, {.scenes = {"a", "b"}, .grammars = {}}, 2.0, clock);
  EXPECT_DOUBLE_EQ(asked.first, 0.25) << "of the slower one";
  EXPECT_DOUBLE_EQ(asked.whole, 0.5);
  EXPECT_EQ(asked.missing, 0);
  EXPECT_EQ(asked.forced, 1);
  EXPECT_EQ(asked.replies.size(), 2U);
  EXPECT_EQ(model.last_deadline(), milliseconds(7'000));
}

TEST(QuestionTimingTest, WhatFailsHasNoAnswer) {
  ManualClock clock;
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::too_late, "too slow"}}, clock);
  const QuestionTiming asked =
      timed_question(model, {.scenes = {"a", "b"}, .grammars = {}}, 2.0, clock);
  EXPECT_EQ(asked.missing, 2);
  EXPECT_EQ(asked.error->message, "too slow");
  EXPECT_TRUE(asked.replies.empty());
}

}  // namespace
}  // namespace saca::model_trials::question_timing_test
