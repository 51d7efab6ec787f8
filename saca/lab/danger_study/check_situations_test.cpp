#include "saca/lab/danger_study/check_situations.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::danger_study::check_situations_test {
namespace {

using learned_danger::CheckedCase;

SituationsTask task(int situations, int threads) {
  return {
      .situations = situations, .threads = threads, .display = long_work::ProgressDisplay::silent};
}

TEST(CheckSituations, AreAsManyAsWantedAndTheSameByAnyThreads) {
  const manoeuvre::Car car = prepare::default_car();
  const auto some = checked_situations(car, blind_network(), task(6, 1)).value();
  const auto more = checked_situations(car, blind_network(), task(8, 3)).value();
  ASSERT_EQ(some.size(), 6U);
  ASSERT_EQ(more.size(), 8U);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].told, more[i].told);
    EXPECT_EQ(some[i].best, more[i].best);
    EXPECT_LE(some[i].best, some[i].acted) << "what was driven is one of those that were tried";
  }
}

TEST(CheckSituations, OfAnotherSeedAreOthers) {
  const manoeuvre::Car car = prepare::default_car();
  SituationsTask other = task(1, 1);
  other.seed = 2;
  EXPECT_NE(checked_situations(car, blind_network(), other).value()[0].told,
            checked_situations(car, blind_network(), task(1, 1)).value()[0].told);
}

/// An interrupt stays one: it gets a process of its own.
TEST(CheckSituationsDeathTest, AreNotKeptOfAnInterrupt) {
  EXPECT_EXIT(
      {
        long_work::watch_for_interrupt();
        (void)std::raise(SIGINT);
        const auto none = checked_situations(prepare::default_car(), blind_network(), task(1, 1));
        const bool right = !none.has_value() && none.error().code == Error::Code::too_late;
        std::_Exit(right ? EXIT_SUCCESS : EXIT_FAILURE);
      },
      testing::ExitedWithCode(EXIT_SUCCESS), "");
}

/// Goes on by a millisecond each time that it is asked.
class CountingClock : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override {
    ++asked_;
    return std::chrono::milliseconds(asked_);
  }
  void wait_until(Time /*time*/) noexcept override {}

 private:
  mutable int asked_ = 0;
};

TEST(CheckSituations, AValuesTimeIsThatOfManyDividedByThem) {
  const CountingClock clock;
  EXPECT_NEAR(microseconds_of_value(blind_network(), clock), 1'000.0 / (2'000.0 * 32.0), 1e-12);
}

}  // namespace
}  // namespace saca::danger_study::check_situations_test
