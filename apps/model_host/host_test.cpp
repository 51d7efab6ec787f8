// The real model through the real child process; skipped where `make model` has not been run.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "saca/reason/child_model.h"
#include "saca/reason/example_situation.h"
#include "saca/reason/prompt.h"

namespace saca::model_host {
namespace {

using namespace std::chrono_literals;
using reason::Answer;

constexpr auto patience = 5min;  // a busy machine is slow; nothing here is about speed

class HostTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(SACA_MODEL)) {
      GTEST_SKIP() << SACA_MODEL << " is not there";
    }
    situation_.posteriors[0][0] = 0.88;
    scene_ = reason::scene_part(situation_, std::nullopt, 0.0);
  }

  [[nodiscard]] reason::ChildModelSettings settings(int max_tokens) const {
    return {.command = {SACA_MODEL_HOST, "--model", SACA_MODEL},
            .system = reason::system_part(),
            .identity = "base",
            .max_tokens = max_tokens};
  }

  SteadyClock clock_;
  preview::Situation situation_ = reason::example_situation();
  std::string scene_;
  std::function<void(const reason::Progress&)> nobody_ = [](const reason::Progress&) {};
};

TEST_F(HostTest, SameQuestionSameReply) {
  reason::ChildModel model(settings(6), clock_);
  const auto once = model.ask({scene_, scene_}, clock_.now() + patience, nobody_);
  const auto again = model.ask({scene_, scene_}, clock_.now() + patience, nobody_);
  ASSERT_TRUE(once.has_value()) << once.error().message;
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(once.value()[0].reply_tokens, 6);
  EXPECT_FALSE(once.value()[0].reasoning.empty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(once.value()[i].reasoning, again.value()[i].reasoning);
    ASSERT_EQ(once.value()[i].answers.size(), 2U);
    EXPECT_EQ(once.value()[i].answers[0].kind, Answer::Kind::first);
    EXPECT_EQ(once.value()[i].answers[1].kind, Answer::Kind::forced);  // cut by max_tokens
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(once.value()[i].answers[k].probability, again.value()[i].answers[k].probability);
    }
  }
  EXPECT_EQ(model.restarts(), 0);
}

// Shared prefix or not, alone or beside others: a scene's first answer is its own.
TEST_F(HostTest, OtherScenesDoNotChangeAFirstAnswer) {
  situation_.scene_at_trigger.ego.v_B.x = 9.0;
  const std::string other = reason::scene_part(situation_, std::nullopt, 0.0);
  reason::ChildModel model(settings(0), clock_);
  const auto alone = model.ask({scene_}, clock_.now() + patience, nobody_);
  const auto beside = model.ask({other, scene_}, clock_.now() + patience, nobody_);
  ASSERT_TRUE(alone.has_value() && beside.has_value());
  ASSERT_EQ(beside.value()[1].answers.size(), 1U);
  EXPECT_EQ(alone.value()[0].answers[0].probability, beside.value()[1].answers[0].probability);
  EXPECT_NE(alone.value()[0].answers[0].probability, beside.value()[0].answers[0].probability);
}

TEST_F(HostTest, KilledInTheMiddleItAnswersTheNextQuestion) {
  reason::ChildModel model(settings(500), clock_);
  const auto cut = model.ask({scene_}, clock_.now() + patience, [&](const reason::Progress& p) {
    if (p.answer != nullptr) {
      kill(model.pid().value(), SIGKILL);
    }
  });
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut.value()[0].answers.size(), 1U);
  EXPECT_EQ(model.restarts(), 1);
  model.kill();
}

TEST_F(HostTest, PromptThatDoesNotFitIsRefused) {
  reason::ChildModel model(settings(6), clock_);
  std::string endless;
  for (int i = 0; i < 2000; ++i) {
    endless += "car ";
  }
  const auto refused = model.ask({endless}, clock_.now() + patience, nobody_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("want at most"), std::string::npos);
  EXPECT_TRUE(model.ask({scene_}, clock_.now() + patience, nobody_).has_value());
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(HostTest, MissingWeightsAreNamed) {
  reason::ChildModelSettings missing = settings(6);
  missing.command.back() = "/no/such/weights.gguf";
  reason::ChildModel model(missing, clock_);
  const auto refused = model.ask({scene_}, clock_.now() + patience, nobody_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("/no/such/weights.gguf"), std::string::npos);
}

}  // namespace
}  // namespace saca::model_host
