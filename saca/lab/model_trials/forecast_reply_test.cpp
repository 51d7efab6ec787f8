#include "saca/lab/model_trials/forecast_reply.h"

#include <gmock/gmock.h>

#include <chrono>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::model_trials::forecast_reply_test {
namespace {

using language_model::Answer;
using language_model::ScriptedModel;
using language_model::ScriptedReply;
using manoeuvre::PolicyId;
using std::chrono::milliseconds;
using testing::ElementsAre;

std::vector<arbitration::Preview> one_preview() {
  arbitration::Preview preview;
  preview.situation = language_model::example_situation();
  preview.situation.spreads.assign(preview.situation.scene_at_trigger.actors.size(),
                                   {.at = {world::Spread{}}});  // all is known exactly
  preview.newest_scene = preview.situation.scene_at_trigger;
  preview.prompt = language_model::scene_part(preview.situation, std::nullopt, 0.0);
  return {preview};
}

/// Reasons for braking, then that choice.
ScriptedReply braking() {
  return {.lines = {{.after = milliseconds(50),
                     .text = language_model::example_reasons,
                     .answer = Answer::Kind::ended,
                     .policy = PolicyId::aeb}}};
}

TEST(ForecastReplyTest, AnswersAreDatedFromTheQuestion) {
  ManualClock clock;
  clock.set(milliseconds(5'000));
  ScriptedModel model(braking(), clock);
  std::vector<std::string> heard;
  const auto replies = replies_about(one_preview(), model, milliseconds(4'000), clock,
                                     [&](std::size_t number, std::string_view text) {
                                       heard.push_back(std::to_string(number) + std::string(text));
                                     });
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value().at(0).answers.back().time, milliseconds(50));
  EXPECT_THAT(heard, ElementsAre("0" + std::string(language_model::example_reasons)));
  EXPECT_THAT(model.last_scenes(), ElementsAre(one_preview()[0].prompt));
  EXPECT_EQ(model.last_deadline(), milliseconds(9'000));
}

TEST(ForecastReplyTest, TheModelsErrorIsTold) {
  ManualClock clock;
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::too_late, "too slow"}}, clock);
  const auto replies = replies_about(one_preview(), model, milliseconds(1), clock,
                                     [](std::size_t, std::string_view) {});
  EXPECT_EQ(replies.error().message, "too slow");
}

class Considering : public testing::Test {
 protected:
  [[nodiscard]] std::vector<ForecastReply> of(language_model::Reply said) {
    ScriptedModel model(braking(), clock_);
    return considered(previews_, {std::move(said)}, {.car = &car_, .harm = &harm_}, model, clock_);
  }
  std::vector<arbitration::Preview> previews_ = one_preview();
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  ManualClock clock_;
};

TEST_F(Considering, HoldsReasonsAgainstWhatIsComputed) {
  language_model::Reply said{.reasoning = language_model::example_reasons};
  said.answers.push_back({.kind = Answer::Kind::ended});
  said.answers.back().probability.at(manoeuvre::index(PolicyId::aeb)) = 1.0;
  const auto all = of(said);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].preview, previews_.data());
  EXPECT_EQ(all[0].truth.num_checked, 3);  // whom it hits, the harm, by how much it is clear
  EXPECT_TRUE(all[0].truth.wrong.empty());
  EXPECT_TRUE(all[0].check->passed) << "braking itself always passes";
  EXPECT_EQ(all[0].explanation->from, language_model::Explanation::From::model);
}

TEST_F(Considering, WhatHasNoAnswerChoosesNothing) {
  const auto all = of({.reasoning = "1. AEB hits truck1.\n"});
  EXPECT_FALSE(all[0].check.has_value());
  EXPECT_FALSE(all[0].explanation.has_value());
  EXPECT_EQ(all[0].truth.wrong.size(), 1U) << "it is clear";
}

}  // namespace
}  // namespace saca::model_trials::forecast_reply_test
