#include "saca/lab/benchmarks/avoidance_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "saca/lab/benchmarks/ticking_clock_for_test.h"

namespace saca::benchmarks::avoidance_times_test {
namespace {

constexpr const char* shipped = "data/reach/parked_car.toml";

TEST(AvoidanceTimes, AreOfAParkedCarOnMorePoints) {
  const auto parked = parked_car_with_more_points(shipped);
  ASSERT_TRUE(parked.has_value()) << parked.error().message;
  EXPECT_EQ(danger::num_cells(parked.value().grid), 60U * 26U * 48U * 28U);
  EXPECT_EQ(parked.value().times, std::vector{4.0});
  EXPECT_EQ(parked.value().system.grip, 0.9);
  EXPECT_EQ(parked_car_with_more_points("no_such.toml").error().code, Error::Code::unreadable);
}

// By this clock each look takes a millisecond: the steps between the first and the last as well.
TEST(AvoidanceTimes, CountStepsPointsAndMemory) {
  danger::AvoidanceCase small = parked_car_with_more_points(shipped).value();
  for (danger::Axis& axis : small.grid.axes) {
    axis.points = 14;
  }
  small.times = {1.2};
  std::vector<std::string> noted;
  const TickingClock clock;
  const auto times =
      avoidance_times(small, clock, [&](const std::string& what) { noted.push_back(what); });
  ASSERT_TRUE(times.has_value()) << times.error().message;
  const nlohmann::json& all = times.value().figures;
  const double points = 14.0 * 14.0 * 14.0 * 14.0;
  const double steps = all.at("reach.avoid4d.steps");
  EXPECT_EQ(all.at("reach.avoid4d.points"), points);
  EXPECT_GT(steps, 2.0);
  EXPECT_NEAR(all.at("reach.avoid4d.seconds").get<double>(), 1e-3 * (steps + 1.0), 1e-9);
  EXPECT_NEAR(all.at("reach.avoid4d.ns_per_point_stage").get<double>(), 1e6 / (2.0 * points), 1e-6);
  EXPECT_GT(all.at("reach.avoid4d.foretold_mib"), 4.0 * points / (1024.0 * 1024.0));
  EXPECT_TRUE(times.value().solved.complete);
  ASSERT_EQ(noted.size(), 2U);
  EXPECT_EQ(noted[0], "a parked car in four dimensions, 38416 points");
  EXPECT_THAT(noted[1], testing::EndsWith(" of 1.2 s"));
}

}  // namespace
}  // namespace saca::benchmarks::avoidance_times_test
