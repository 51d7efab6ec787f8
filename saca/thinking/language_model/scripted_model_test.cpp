#include "saca/thinking/language_model/scripted_model.h"

#include <gmock/gmock.h>

#include "saca/thinking/language_model/news_for_test.h"

namespace saca::language_model::scripted_model_test {
namespace {

using namespace std::chrono_literals;
using manoeuvre::PolicyId;

using ScriptedModelTest = NewsTest;

TEST_F(ScriptedModelTest, SaysEachLineAtItsTime) {
  ScriptedModel model(
      [](const std::string& scene) {
        const Clock::Time after = scene == "a" ? 2s : 1s;
        return ScriptedReply{.lines = {{.after = after, .text = "about " + scene},
                                       {.after = 2 * after,
                                        .text = ".",
                                        .answer = Answer::Kind::ended,
                                        .policy = PolicyId::aes_left,
                                        .probability = 0.86}},
                             .prompt_tokens = 330,
                             .reply_tokens = 7};
      },
      clock_);
  clock_.advance(10s);
  const auto replies = model.ask({"a", "b"}, 20s, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_THAT(news_, testing::ElementsAre("11 s: 1 about b", "12 s: 0 about a", "12 s: 1 .",
                                          "12 s: 1 answers", "14 s: 0 .", "14 s: 0 answers"));
  const Reply& reply = replies.value()[0];
  EXPECT_EQ(reply.reasoning, "about a.");
  EXPECT_EQ(reply.prompt_tokens, 330);
  EXPECT_EQ(reply.reply_tokens, 7);
  ASSERT_EQ(reply.answers.size(), 1U);
  EXPECT_EQ(reply.answers[0].time, 14s);
  EXPECT_EQ(reply.answers[0].probability[1], 0.86);
  EXPECT_NEAR(reply.answers[0].probability[0], 0.02, 1e-15);  // 0.14 for seven
  EXPECT_EQ(model.num_asked(), 1);
  EXPECT_THAT(model.last_scenes(), testing::ElementsAre("a", "b"));
  EXPECT_EQ(model.last_deadline(), 20s);
}

TEST_F(ScriptedModelTest, ReturnsBeforeTheDeadlineWithWhatIsSaid) {
  ScriptedModel model(ScriptedReply{.lines = {{.after = 1s, .answer = Answer::Kind::first},
                                              {.after = 3s, .answer = Answer::Kind::ended}}},
                      clock_);
  const auto replies = model.ask({"a"}, 2s, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_EQ(clock_.now(), 1999ms);
}

TEST_F(ScriptedModelTest, WithoutAWordItIsLate) {
  ScriptedModel model(ScriptedReply{}, clock_);
  const auto replies = model.ask({"a"}, 2s, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  EXPECT_EQ(clock_.now(), 1999ms);
}

TEST_F(ScriptedModelTest, FailsAtOnceWhereToldTo) {
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::unreadable, "gone"}}, clock_);
  const auto replies = model.ask({"a"}, 2s, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().message, "gone");
  EXPECT_EQ(clock_.now(), 0s);
}

TEST_F(ScriptedModelTest, OnePolicyIsSaidAtOnce) {
  ScriptedModel model(PolicyId::t_drift_left, clock_);
  const auto replies = model.ask({"a", "b"}, 2s, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(replies.value()[1].answers[0].probability[5], 1.0);
  EXPECT_EQ(replies.value()[1].answers[0].probability[0], 0.0);
}

}  // namespace
}  // namespace saca::language_model::scripted_model_test
