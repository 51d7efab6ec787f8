#include "saca/core/clock.h"

#include <gtest/gtest.h>

namespace saca {
namespace {

using std::chrono::milliseconds;

TEST(ManualClock, MovesOnlyWhenTold) {
  ManualClock clock;
  EXPECT_EQ(clock.now(), milliseconds(0));
  clock.advance(milliseconds(5));
  EXPECT_EQ(clock.now(), milliseconds(5));
  clock.wait_until(milliseconds(9));
  EXPECT_EQ(clock.now(), milliseconds(9));
  clock.wait_until(milliseconds(3));  // has passed
  EXPECT_EQ(clock.now(), milliseconds(9));
}

TEST(ClockTime, IsSecondsAndBack) {
  EXPECT_EQ(from_seconds(-1.25), milliseconds(-1250));
  EXPECT_EQ(to_seconds(milliseconds(1250)), 1.25);
}

TEST(SteadyClock, NeverRunsBackAndWaitsLongEnough) {
  SteadyClock clock;
  const Clock::Time start = clock.now();
  clock.wait_until(start + milliseconds(1));
  EXPECT_GE(clock.now() - start, milliseconds(1));
}

TEST(WaitUntil, GoesOnUntilTheTimeUnlessAStopIsAskedFor) {
  ManualClock clock;
  wait_until(clock, milliseconds(25), {});
  EXPECT_EQ(clock.now(), milliseconds(25));
  std::stop_source stop;
  wait_until(clock, milliseconds(95), stop.get_token());
  EXPECT_EQ(clock.now(), milliseconds(95));
  stop.request_stop();
  wait_until(clock, milliseconds(200), stop.get_token());
  EXPECT_EQ(clock.now(), milliseconds(95));
}

}  // namespace
}  // namespace saca
