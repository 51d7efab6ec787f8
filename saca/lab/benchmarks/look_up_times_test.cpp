#include "saca/lab/benchmarks/look_up_times.h"

#include <gtest/gtest.h>

#include <vector>

#include "saca/lab/benchmarks/ticking_clock_for_test.h"

namespace saca::benchmarks::look_up_times_test {
namespace {

danger::Solution flat() {
  danger::Solution solved{
      .grid =
          {{{.name = "x", .first = 0.0, .last = 3.0, .points = 4},
            {.name = "y", .first = 0.0, .last = 3.0, .points = 4, .edge = danger::Edge::mirrored}}},
      .times = {1.0}};
  solved.values = danger::Snapshots<float>{std::vector<float>(16, 1.0F)};
  return solved;
}

TEST(LookUpTimes, AreThoseOfOneValue) {
  const TickingClock clock;
  const nlohmann::json all = look_up_times(flat(), clock, 10);
  EXPECT_EQ(all.size(), 2U);
  EXPECT_NEAR(all.at("reach.lookup_us.p50").get<double>(), 1000.0 / 16.0, 1e-9);
  EXPECT_NEAR(all.at("reach.lookup_us.p99").get<double>(), 1000.0 / 16.0, 1e-9);
}

}  // namespace
}  // namespace saca::benchmarks::look_up_times_test
