#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/stepping_clock_for_test.h"

namespace saca::language_model {

// A model and what it needs, made to answer by the text of a scene:
//   "scene N"   policy N, certain, at once
//   "silence"   never
//   "failure"   the question fails
struct ModelStand {
  virtual ~ModelStand() = default;
  virtual LanguageModel& model() = 0;

  SteppingClock clock;
};

// What every adapter of the port does. A file makes the stands:
//   INSTANTIATE_TEST_SUITE_P(Models, ModelSuite, testing::Values(StandCase{...}), case_name);
struct StandCase {
  std::string name;
  std::function<std::unique_ptr<ModelStand>()> make;
};
inline std::string case_name(const testing::TestParamInfo<StandCase>& info) {
  return info.param.name;
}

class ModelSuite : public testing::TestWithParam<StandCase> {
 protected:
  // Far more than any adapter keeps for itself; time passes by fewer than five such steps in that.
  static constexpr Clock::Time time_to_answer = std::chrono::seconds(4);
  static constexpr Clock::Time step = std::chrono::milliseconds(100);

  Result<std::vector<Reply>> ask(const std::vector<std::string>& scenes, Clock::Time deadline,
                                 const std::stop_token& stop = {}) {
    const auto note = [this](const Progress& p) {
      elsewhere_ = elsewhere_ || std::this_thread::get_id() != here_;
      text_ += p.text;
      if (p.answer != nullptr) {
        told_.push_back(p.prompt);
      }
    };
    return stand_->model().ask(scenes, deadline, note, {.stop = stop});
  }
  void expect_answers(const std::vector<std::string>& scenes) {
    told_.clear();
    const auto replies = ask(scenes, stand_->clock.now() + time_to_answer);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    ASSERT_EQ(replies.value().size(), scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const std::vector<Answer>& answers = replies.value()[i].answers;
      ASSERT_FALSE(answers.empty());
      const auto policy = static_cast<std::size_t>(scenes[i].back() - '0');
      EXPECT_EQ(answers.back().probability.at(policy), 1.0) << scenes[i];
    }
  }

  std::unique_ptr<ModelStand> stand_ = GetParam().make();
  std::thread::id here_ = std::this_thread::get_id();
  bool elsewhere_ = false;
  std::string text_;
  std::vector<std::size_t> told_;  // scenes whose answers were told of
};

TEST_P(ModelSuite, OneReplyPerSceneInTheirOrder) {
  expect_answers({"scene 5"});
  expect_answers({"scene 7", "scene 0"});
  expect_answers({"scene 3", "scene 1", "scene 2"});
}

TEST_P(ModelSuite, EachAnswerIsToldOfOnTheAskingThread) {
  const auto replies = ask({"scene 3", "scene 1", "scene 2"}, time_to_answer);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  for (std::size_t i = 0; i < replies.value().size(); ++i) {
    const Reply& reply = replies.value()[i];
    EXPECT_EQ(static_cast<std::size_t>(std::count(told_.begin(), told_.end(), i)),
              reply.answers.size());
    for (const Answer& answer : reply.answers) {
      double sum = 0.0;
      for (const double p : answer.probability) {
        EXPECT_GE(p, 0.0);
        sum += p;
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);  // rounding of eight numbers
      EXPECT_LT(answer.time, time_to_answer);
    }
    EXPECT_NE(text_.find(reply.reasoning), std::string::npos) << reply.reasoning;
  }
  EXPECT_FALSE(elsewhere_);
}

TEST_P(ModelSuite, PassedDeadlineIsTooLate) {
  expect_answers({"scene 1"});  // a process is loaded by now
  told_.clear();
  const auto replies = ask({"scene 1"}, stand_->clock.now());
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  EXPECT_TRUE(told_.empty());
}

TEST_P(ModelSuite, ShortDeadlineIsKept) {
  expect_answers({"scene 1"});
  stand_->clock.step(step);
  for (const Clock::Time time : {5 * step, 25 * step}) {
    const Clock::Time deadline = stand_->clock.now() + time;
    const auto replies = ask({"scene 1", "scene 2"}, deadline);
    EXPECT_TRUE(replies.has_value() || replies.error().code == Error::Code::too_late)
        << replies.error().message;
    EXPECT_LT(stand_->clock.last_look(), deadline);
  }
}

TEST_P(ModelSuite, SilenceIsLate) {
  expect_answers({"scene 1"});
  stand_->clock.step(step);
  const Clock::Time deadline = stand_->clock.now() + time_to_answer;
  const auto replies = ask({"silence"}, deadline);
  EXPECT_LT(stand_->clock.last_look(), deadline);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
}

TEST_P(ModelSuite, FailureIsOneLineAndTheNextQuestionWorks) {
  for (const char* bad : {"failure", "silence"}) {
    stand_->clock.step(step);
    const auto replies = ask({bad}, stand_->clock.now() + time_to_answer);
    stand_->clock.step(Clock::Time(0));
    ASSERT_FALSE(replies.has_value());
    EXPECT_FALSE(replies.error().message.empty());
    EXPECT_EQ(replies.error().message.find('\n'), std::string::npos);
    expect_answers({"scene 4", "scene 6"});
  }
}

// Whoever does not hear the stop waits for an hour of looks, 10 ms each: longer than a test may.
TEST_P(ModelSuite, WithdrawnQuestionEndsAndTheNextOneWorks) {
  expect_answers({"scene 1"});
  stand_->clock.step(step);
  std::stop_source stop;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop.request_stop();
  });
  const auto replies =
      ask({"silence"}, stand_->clock.now() + std::chrono::hours(1), stop.get_token());
  stopper.join();
  stand_->clock.step(Clock::Time(0));
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  expect_answers({"scene 4", "scene 6"});

  told_.clear();
  const auto never = ask({"scene 1"}, stand_->clock.now() + time_to_answer, stop.get_token());
  EXPECT_TRUE(never.has_value() || never.error().code == Error::Code::too_late);
  expect_answers({"scene 4"});
}

TEST_P(ModelSuite, HasADescription) {
  EXPECT_FALSE(stand_->model().description().empty());
}

}  // namespace saca::language_model
