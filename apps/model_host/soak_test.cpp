// Deadlines and deaths of the real model, for `make soak` (SACA_SOAK_ASKS, SACA_SOAK_CHILD_KILLS):
// what it measures is the machine's. That no deadline is overrun holds beside one busy core, which
// the test itself keeps busy, on a machine that has nothing else to do; without the variables only
// few are asked, and what must hold on any machine is held. What the planes do when a model is
// late, silent or dies is tested on a clock of its own in language_model/child_model_test.cpp.
// Skipped where `make model` has not been run.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::model_host::soak_test {
namespace {

using namespace std::chrono_literals;

constexpr auto loading = 5min;

/// How many; `soaking` where somebody said so.
struct Number {
  int num = 0;
  bool soaking = false;
};
Number from_environment(const char* name, int otherwise) {
  const char* const text = std::getenv(name);
  return {text == nullptr ? otherwise : std::atoi(text), text != nullptr};
}

/// A whole reply takes ten seconds of a busy core, and says no more of deaths than its beginning.
bool soaking() {
  return from_environment("SACA_SOAK_ASKS", 0).soaking ||
         from_environment("SACA_SOAK_CHILD_KILLS", 0).soaking;
}

/// Keeps one core busy for as long as it lives.
class BusyCore {
 public:
  BusyCore()
      : thread_([this] {
          while (!stop_) {
            work_ = work_ * 1.0000001 + 1.0;
          }
        }) {}
  BusyCore(const BusyCore&) = delete;
  BusyCore& operator=(const BusyCore&) = delete;
  ~BusyCore() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  double work_ = 1.0;
  std::thread thread_;
};

class SoakTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(SACA_MODEL)) {
      GTEST_SKIP() << SACA_MODEL << " is not there";
    }
    for (unsigned seed = 0; seed < 8; ++seed) {
      scenes_.push_back(
          language_model::scene_part(language_model::crowded_situation(seed), std::nullopt, 0.0));
    }
  }

  std::vector<std::string> some_scenes() {
    std::vector<std::string> some;
    for (int n = std::uniform_int_distribution<int>(1, 3)(random_); n > 0; --n) {
      some.push_back(scenes_[std::uniform_int_distribution<std::size_t>(0, 7)(random_)]);
    }
    return some;
  }
  /// Equally often in each octave.
  Clock::Time drawn(double low, double high) {
    return from_seconds(
        std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random_)));
  }

  SteadyClock clock_;
  std::mt19937 random_{11};
  std::vector<std::string> scenes_;
  language_model::ChildModel model_{
      {.command = {SACA_MODEL_HOST, "--model", SACA_MODEL, "--threads", "2", "--give-way"},
       .system = language_model::system_part(prepare::read_harm(SACA_HARM).value()),
       .identity = "base",
       .max_tokens = soaking() ? language_model::ChildModelSettings{}.max_tokens : 24},
      clock_};
};

TEST_F(SoakTest, DeadlinesAreKeptWhileTheOtherCoreIsBusy) {
  const auto [num, soaking] = from_environment("SACA_SOAK_ASKS", 3);
  ASSERT_FALSE(model_.wait_until_ready(clock_.now() + loading).has_value());
  const BusyCore other;
  int overruns = 0;
  int answered = 0;
  int at_once = 0;
  double worst = -1e9;
  for (int i = 0; i < num; ++i) {
    const Clock::Time begin = clock_.now();
    const Clock::Time deadline = begin + drawn(0.05, 4.0);
    const auto replies =
        model_.ask(some_scenes(), deadline, [](const language_model::Progress&) {});
    const double over = to_seconds(clock_.now() - deadline);
    worst = std::max(worst, over);
    overruns += over > 0.0 ? 1 : 0;
    answered += replies.has_value() ? 1 : 0;
    at_once += !replies.has_value() && clock_.now() - begin < 20ms ? 1 : 0;
    if (!replies.has_value()) {
      EXPECT_EQ(replies.error().code, Error::Code::too_late) << replies.error().message;
    }
  }
  fmt::print(
      "{} asks, {} answered, {} refused at once, {} after the deadline, nearest {:.1f} ms, "
      "process begun again {} times\n",
      num, answered, at_once, overruns, 1e3 * worst, model_.restarts());
  if (soaking) {
    EXPECT_EQ(overruns, 0);
  }
}

TEST_F(SoakTest, OutlivesItsModel) {
  const auto [num, soaking] = from_environment("SACA_SOAK_CHILD_KILLS", 3);
  const double patience = soaking ? 4.0 : 1.0;  // [s]
  int answered = 0;
  int overruns = 0;
  for (int i = 0; i < num; ++i) {
    ASSERT_FALSE(model_.wait_until_ready(clock_.now() + loading).has_value());
    const pid_t child = model_.pid().value();
    const int signal = std::array{SIGKILL, SIGABRT, SIGSTOP}.at(static_cast<std::size_t>(i % 3));
    const Clock::Time moment = drawn(0.01, 0.75 * patience);
    std::thread killer([&] {
      std::this_thread::sleep_for(moment);
      kill(child, signal);
    });
    const Clock::Time deadline = clock_.now() + from_seconds(patience);
    const auto replies =
        model_.ask(some_scenes(), deadline, [](const language_model::Progress&) {});
    overruns += clock_.now() > deadline ? 1 : 0;
    killer.join();
    answered += replies.has_value() ? 1 : 0;
    if (replies.has_value()) {
      for (const language_model::Reply& reply : replies.value()) {
        EXPECT_TRUE(reply.answers.empty() || reply.reasoning.size() < 65'536);
      }
    }
    model_.kill();  // it may have ended before the signal came
  }
  fmt::print("{} deaths, {} asks answered all the same, {} after the deadline\n", num, answered,
             overruns);
  if (soaking) {
    EXPECT_EQ(overruns, 0);
  }
  EXPECT_TRUE(
      model_.ask({scenes_[0]}, clock_.now() + loading, [](const language_model::Progress&) {})
          .has_value());
}

}  // namespace
}  // namespace saca::model_host::soak_test
