#include "saca/lab/benchmarks/call_times.h"

#include <gtest/gtest.h>

#include <limits>

#include "saca/lab/benchmarks/ticking_clock_for_test.h"

namespace saca::benchmarks::call_times_test {
namespace {

TEST(CallTimes, AreOfOneCall) {
  const TickingClock clock;
  std::size_t calls = 0;
  const nlohmann::json all = call_times(
      "a",
      [&](std::size_t i) {
        EXPECT_EQ(i, calls);
        ++calls;
        return 1.0;
      },
      clock, 5);
  EXPECT_EQ(calls, 5U * 16U);
  EXPECT_NEAR(all.at("a.p50").get<double>(), 1000.0 / 16.0, 1e-9);  // 1 ms for 16 of them
  EXPECT_NEAR(all.at("a.p99").get<double>(), 1000.0 / 16.0, 1e-9);
}

TEST(CallTimes, ShowWhereACallGivesNoNumber) {
  const TickingClock clock;
  const nlohmann::json all = call_times(
      "a", [](std::size_t) { return std::numeric_limits<double>::quiet_NaN(); }, clock, 2);
  EXPECT_TRUE(std::isnan(all.at("a.p50").get<double>()));
}

}  // namespace
}  // namespace saca::benchmarks::call_times_test
