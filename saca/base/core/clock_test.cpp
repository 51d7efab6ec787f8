#include "saca/base/core/clock.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "tests/support/meeting_clock.h"

namespace saca::clock_test {
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
  clock.wait_until_or_stop(milliseconds(25), {});
  EXPECT_EQ(clock.now(), milliseconds(25));
  std::stop_source stop;
  clock.wait_until_or_stop(milliseconds(95), stop.get_token());
  EXPECT_EQ(clock.now(), milliseconds(95));
  stop.request_stop();
  clock.wait_until_or_stop(milliseconds(200), stop.get_token());
  EXPECT_EQ(clock.now(), milliseconds(95));
}

// Two threads, of which one works in real time while the other waits: time stands still for it, and
// goes on from one moment that is waited for to the next.
TEST(MeetingClock, GoesOnWhenAllWait) {
  MeetingClock clock(2);
  std::vector<Clock::Time> here;
  std::vector<Clock::Time> there;
  std::jthread other([&] {
    for (int k = 1; k <= 3; ++k) {
      std::this_thread::yield();
      clock.wait_until(milliseconds(10 * k));
      there.push_back(clock.now());
    }
    clock.wait_until(milliseconds(41));
  });
  for (int k = 1; k <= 4; ++k) {
    clock.wait_until(milliseconds(10 * k + 1));
    here.push_back(clock.now());
  }
  other.join();
  EXPECT_EQ(there,
            (std::vector<Clock::Time>{milliseconds(10), milliseconds(20), milliseconds(30)}));
  EXPECT_EQ(here, (std::vector<Clock::Time>{milliseconds(11), milliseconds(21), milliseconds(31),
                                            milliseconds(41)}));
  clock.wait_until(milliseconds(100));  // alone again
  EXPECT_EQ(clock.now(), milliseconds(100));
}

TEST(MeetingClock, AStopEndsAWaitWithoutTime) {
  MeetingClock clock(2);
  std::jthread other(
      [&](const std::stop_token& stop) { clock.wait_until_or_stop(std::chrono::hours(1), stop); });
  clock.wait_until(milliseconds(5));
  other.request_stop();
  other.join();
  EXPECT_EQ(clock.now(), milliseconds(5));
}

}  // namespace
}  // namespace saca::clock_test
