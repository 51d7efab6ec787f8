#include "saca/runtime/charged_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/thinking/language_model/scripted_model.h"

namespace saca::runtime::charged_model_test {
namespace {

using language_model::Answer;
using testing::HasSubstr;

const language_model::ScriptedReply two_answers{
    .lines = {{.text = "so", .answer = Answer::Kind::first}, {.answer = Answer::Kind::ended}},
    .prompt_tokens = 100,
    .reply_tokens = 40};

constexpr ThinkingCosts costs{.preview = 0.0, .prompt_token = 0.001, .reply_token = 0.01};

TEST(ChargedModel, DatesAnswersByTheirTokens) {
  ManualClock simulated;
  simulated.advance(std::chrono::seconds(2));
  ManualClock real;
  language_model::ScriptedModel inner(two_answers, real);
  ChargedModel model(inner, costs, real, simulated);
  std::vector<double> dates;
  const auto replies = model.ask({"a", "b"}, std::chrono::seconds(9), [&](const auto& news) {
    if (news.answer != nullptr) {
      dates.push_back(std::chrono::duration<double>(news.answer->time).count());
    }
  });
  ASSERT_TRUE(replies.has_value());
  // Two prompts of 100 tokens at 1 ms, then 40 steps of 10 ms for both replies together.
  EXPECT_THAT(dates, testing::Pointwise(testing::DoubleNear(1e-6), {2.2, 2.2, 2.6, 2.6}));
}

TEST(ChargedModel, AnAnswerAfterTheDeadlineDidNotCome) {
  const ManualClock simulated;
  ManualClock real;
  language_model::ScriptedModel inner(two_answers, real);
  ChargedModel model(inner, costs, real, simulated);
  const auto silent = [](const auto&) {};
  const auto first_only = model.ask({"a"}, std::chrono::milliseconds(200), silent);
  ASSERT_TRUE(first_only.has_value());
  EXPECT_EQ(first_only.value()[0].answers.size(), 1U);
  EXPECT_EQ(first_only.value()[0].reasoning, "");
  EXPECT_EQ(first_only.value()[0].reply_tokens, 0);
  const auto none = model.ask({"a"}, std::chrono::milliseconds(50), silent);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, Error::Code::too_late);
}

TEST(ThinkingCosts, AreReadStrictly) {
  const auto good = read_thinking_costs(
      "preview_s = 0.1\nverdict_s = 0.03\nprompt_token_s = 0.001\nreply_token_s = 0.01", "c.toml");
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(good.value().prompt_token, 0.001);
  const auto bad = read_thinking_costs(
      "preview_s = -1\nverdict_s = 0.03\nprompt_token_s = 0.001\nreply_token_s = 0.01", "c.toml");
  ASSERT_FALSE(bad.has_value());
  EXPECT_THAT(bad.error().message, HasSubstr("c.toml:1: preview_s"));
}

}  // namespace
}  // namespace saca::runtime::charged_model_test
