#include "saca/lab/benchmarks/vehicle_times.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "saca/lab/benchmarks/counted_clock_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::benchmarks::vehicle_times_test {
namespace {

TEST(VehicleTimes, StepsOverTheTimeBetweenTwoLooksAtTheClock) {
  const CountedClock clock;
  const nlohmann::json figures = vehicle_times(prepare::default_car(), clock, 3);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_NEAR(figures.at("vehicle.steps_per_s").get<double>(), 3 * 2'000 / 1e-6, 1.0);
}

}  // namespace
}  // namespace saca::benchmarks::vehicle_times_test
