#include "saca/thinking/language_model/child_model.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "saca/thinking/language_model/scripted_child_for_test.h"
#include "saca/thinking/language_model/stepping_clock_for_test.h"

namespace saca::language_model::child_model_test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto deadline = 4s;

ChildModelSettings settings(const std::string& behaviour) {
  return {.command = scripted_child(behaviour),
          .system = "rules",
          .identity = "weights 1",
          .margin = 2.0};
}

bool alive(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string number;
  std::string name;
  std::string state;
  file >> number >> name >> state;
  return file && state != "Z";
}

void wait_until_gone(pid_t pid) {
  while (alive(pid)) {
    std::this_thread::yield();
  }
}

class ChildModelTest : public testing::Test {
 protected:
  // Ready, and from then on time passes at each look.
  void expect_ready(ChildModel& model) {
    ASSERT_FALSE(model.wait_until_ready(deadline).has_value());
    clock_.step(step_);
  }

  SteppingClock clock_;
  Clock::Time step_ = 100ms;  // fewer than five of them fill the time kept for the way back
  std::vector<std::string> news_;
  std::function<void(const Progress&)> record_ = [this](const Progress& p) {
    news_.push_back(std::to_string(p.prompt) + (p.answer != nullptr ? " answer" : " ") +
                    std::string(p.text));
  };
};

TEST_F(ChildModelTest, EverythingSaidComesBack) {
  ChildModel model(settings(R"(ready; ask; first 0; first 1; text 1 'it '; text 0 'so'
text 1 'is'; ended 1; ended 0; done_; cat)"),
                   clock_);
  const auto replies = model.ask({"a", "b"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  ASSERT_EQ(replies.value().size(), 2U);
  EXPECT_EQ(replies.value()[0].reasoning, "so");
  EXPECT_EQ(replies.value()[1].reasoning, "it is");
  EXPECT_EQ(replies.value()[1].reply_tokens, 4);
  ASSERT_EQ(replies.value()[0].answers.size(), 2U);
  EXPECT_EQ(replies.value()[0].answers[0].kind, Answer::Kind::first);
  EXPECT_EQ(replies.value()[0].answers[0].probability[4], 1.0);
  EXPECT_EQ(replies.value()[0].answers[1].kind, Answer::Kind::ended);
  EXPECT_THAT(news_, testing::ElementsAre("0 answer", "1 answer", "1 it ", "0 so", "1 is",
                                          "1 answer", "0 answer"));
  EXPECT_EQ(model.figures().system_tokens, 9);
  EXPECT_EQ(model.figures().prompt_time, 0.25);
  EXPECT_EQ(model.description(), "weights 1 (fake)");
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, AnswersBeforeADeathCountAndTheNextQuestionWorks) {
  ChildModel model(settings("ready; ask; first 0; kill -9 $$"), clock_);
  for (int i = 0; i < 2; ++i) {
    const auto replies = model.ask({"a", "b"}, deadline, record_);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    EXPECT_EQ(replies.value()[0].answers.size(), 1U);
    EXPECT_EQ(replies.value()[1].answers.size(), 0U);
    EXPECT_EQ(model.restarts(), i + 1);
  }
}

TEST_F(ChildModelTest, DeathBeforeAnyAnswerIsAnError) {
  ChildModel model(settings("ready; ask; kill -9 $$"), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::unreadable);
}

TEST_F(ChildModelTest, StoppedProcessIsKilledInTime) {
  ChildModel model(settings("ready; ask; kill -STOP $$"), clock_);
  expect_ready(model);
  const pid_t first = model.pid().value();
  const auto replies = model.ask({"a"}, deadline, record_);
  EXPECT_LT(clock_.now(), deadline);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  wait_until_gone(first);
  EXPECT_EQ(model.restarts(), 1);
}

TEST_F(ChildModelTest, SilentProcessIsKilledInTime) {
  ChildModel model(settings("ready; ask; sleep 1000"), clock_);
  expect_ready(model);
  const pid_t first = model.pid().value();
  const auto replies = model.ask({"a"}, deadline, record_);
  EXPECT_LT(clock_.now(), deadline);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  wait_until_gone(first);
}

TEST_F(ChildModelTest, WithdrawnQuestionKeepsItsAnswersAndItsProcess) {
  ChildModel model(settings(R"(ready; ask; first 0; read -r cancel; case $cancel in
*'"cmd":"cancel","id":'$id,*) done_;; esac; ask; first 0; done_; cat)"),
                   clock_);
  std::stop_source stop;
  const auto replies = model.ask({"a"}, deadline, [&](const Progress&) { stop.request_stop(); },
                                 {.stop = stop.get_token()});
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, SilenceAfterTheFirstAnswerLeavesThatAnswer) {
  ChildModel model(settings("ready; ask; first 0; sleep 1000"), clock_);
  const auto replies = model.ask({"a"}, deadline, [&](const Progress&) { clock_.step(step_); });
  EXPECT_LT(clock_.now(), deadline);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
}

TEST_F(ChildModelTest, ProcessThatNeverReadsIsLate) {
  ChildModel model(settings("ready; sleep 1000"), clock_);
  expect_ready(model);
  const auto replies = model.ask({std::string(4U << 20U, 'x')}, deadline, record_);
  EXPECT_LT(clock_.now(), deadline);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
}

TEST_F(ChildModelTest, NonsenseIsAnError) {
  ChildModel model(settings("ready; ask; echo GGML_ASSERT failed; cat"), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::malformed);
  EXPECT_THAT(replies.error().message, HasSubstr("GGML_ASSERT"));
  EXPECT_EQ(model.restarts(), 1);
}

TEST_F(ChildModelTest, NestedNonsenseIsAnError) {
  ChildModel model(
      settings("ready; ask; printf '{\"v\":%s\\n' \"$(head -c 900000 /dev/zero | tr '\\0' '[')\""),
      clock_);
  expect_ready(model);
  clock_.step(1us);  // the line comes in hundreds of pieces
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::malformed);
  EXPECT_LT(replies.error().message.size(), 300U);
}

TEST_F(ChildModelTest, WhatItSaysOfAFailureIsBoundedAndCommandsNoTerminal) {
  ChildModel model(
      settings(
          "ready; ask; say \"\\\"error\\\",\\\"id\\\":$id,\\\"message\\\":\\\"\\\\u001b[2J$(head "
          "-c 100000 /dev/zero | tr '\\0' x)\\\"\""),
      clock_);
  expect_ready(model);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_THAT(replies.error().message, testing::StartsWith("model process:  [2Jxxx"));
  EXPECT_LT(replies.error().message.size(), 300U);
}

TEST_F(ChildModelTest, AnswersWithoutEndAreAnError) {
  ChildModel model(settings("ready; ask; while :; do first 0; done"), clock_);
  expect_ready(model);
  clock_.step(1us);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value());  // the first of them count
  EXPECT_LE(replies.value().front().answers.size(), 16U);
}

TEST_F(ChildModelTest, LineWithoutEndIsAnError) {
  ChildModel model(settings("ready; ask; tr '\\0' x < /dev/zero"), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::malformed);
}

TEST_F(ChildModelTest, EndlessTalkEndsAtTheDeadlineOrTheLimit) {
  ChildModel model(settings(R"sh(ready; ask; first 0; yes "$(text 0 xxxxxxxxxxxxxxxxxxxxxxxx)")sh"),
                   clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_LE(replies.value()[0].reasoning.size(), 65536U);
}

TEST_F(ChildModelTest, AnswersToOtherQuestionsAreNotHeard) {
  ChildModel model(
      settings("ready; ask; real=$id; id=99; ended 0; done_; id=$real; first 0; done_"), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  ASSERT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_EQ(replies.value()[0].answers[0].kind, Answer::Kind::first);
}

TEST_F(ChildModelTest, AnswerForASceneThatWasNotAskedIsAnError) {
  ChildModel model(settings("ready; ask; first 2; cat"), clock_);
  EXPECT_FALSE(model.ask({"a", "b"}, deadline, record_).has_value());
}

TEST_F(ChildModelTest, RefusedQuestionLeavesTheProcessAlive) {
  ChildModel model(
      settings(R"(ready; ask; say '"error","message":"too long"'; ask; first 0; done_; cat)"),
      clock_);
  const auto refused = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("too long"));
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, ModelThatHasNoTimeSaysSoAtOnce) {
  ChildModel model(settings(R"(ready; ask
say "\"error\",\"id\":$id,\"message\":\"no time\",\"late\":true"; ask; first 0; done_; cat)"),
                   clock_);
  const auto refused = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::too_late);
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, ModelThatWasNotReadyInTimeIsLate) {
  ChildModel model(settings(R"(ready; ask
say "\"done\",\"id\":$id,\"reply_tokens\":[0],\"prompt_s\":1,\"reply_s\":0,\"overran\":true"; cat)"),
                   clock_);
  const auto late = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(late.has_value());
  EXPECT_EQ(late.error().code, Error::Code::too_late);
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, MissingProgramIsNamed) {
  ChildModel model({.command = {"/no/such/model-host"}, .system = "", .identity = ""}, clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::unreadable);
  EXPECT_THAT(replies.error().message, HasSubstr("/no/such/model-host"));
}

TEST_F(ChildModelTest, ProcessThatCannotLoadIsBegunOncePerQuestion) {
  ChildModel model(settings(R"(say '"error","message":"no such file"'; exit 1)"), clock_);
  for (int i = 0; i < 3; ++i) {
    const auto replies = model.ask({"a"}, deadline, record_);
    ASSERT_FALSE(replies.has_value());
    EXPECT_LE(model.restarts(), i);
  }
}

TEST_F(ChildModelTest, SlowLoadIsLateButNotKilled) {
  clock_.step(step_);
  ChildModel model(settings("sleep 1000"), clock_);
  const pid_t first = model.pid().value();
  const auto replies = model.ask({"a"}, clock_.now() + 1s, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  EXPECT_EQ(model.pid(), first);
}

TEST_F(ChildModelTest, PassedDeadlineIsTooLate) {
  ChildModel model(settings("ready; cat"), clock_);
  ASSERT_FALSE(model.wait_until_ready(deadline).has_value());
  const auto replies = model.ask({"a"}, clock_.now(), record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(ChildModelTest, KillFromAnotherThreadEndsTheQuestion) {
  ChildModel model(settings("ready; ask; first 0; sleep 1000"), clock_);
  std::thread killer;
  const auto replies = model.ask(
      {"a"}, deadline, [&](const Progress&) { killer = std::thread([&] { model.kill(); }); });
  killer.join();
  ASSERT_TRUE(replies.has_value());  // time stands still: only the kill can have ended it
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
}

TEST_F(ChildModelTest, NothingIsLeftBehind) {
  pid_t grandchild = 0;
  {
    ChildModel model(
        settings("sleep 1000 & say "
                 "'\"ready\",\"description\":\"'$!'\",\"system_tokens\":1,\"load_s\":1'; ask; cat"),
        clock_);
    ASSERT_FALSE(model.wait_until_ready(deadline).has_value());
    const std::string text = model.description();  // "weights 1 (<number>)"
    grandchild = std::stoi(text.substr(text.find('(') + 1));
    EXPECT_TRUE(alive(grandchild));
  }
  wait_until_gone(grandchild);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child of ours, not even a dead one
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace saca::language_model::child_model_test
