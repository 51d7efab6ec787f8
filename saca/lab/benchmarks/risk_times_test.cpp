#include "saca/lab/benchmarks/risk_times.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "saca/lab/benchmarks/ticking_clock_for_test.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::benchmarks::risk_times_test {
namespace {

/// A value of -1 m where a square at rest, or at 5 m/s, lies within 20 m ahead of the ego.
danger::DangerModel model_of(const world::Footprint& square) {
  const double pi = std::numbers::pi;
  const danger::Grid grid{
      {{.name = "x", .first = -25.0, .last = 25.0, .points = 5},
       {.name = "y", .first = -25.0, .last = 25.0, .points = 5},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = danger::Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 30.0, .points = 5}}};
  const auto values = std::make_shared<danger::ValueTable>(
      grid, std::vector<float>(danger::num_cells(grid), -1.0F));
  return {{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48},
          square,
          {{square, 0.0, danger::View::obstacle, values},
           {square, 5.0, danger::View::obstacle, values}}};
}

TEST(RiskTimes, AreTakenApartWhereATableHasTheMeetingAndWhereNot) {
  const world::Footprint square{.length = 2.0, .width = 2.0};
  const TickingClock clock;
  std::vector<std::string> noted;
  const nlohmann::json all =
      risk_times(model_of(square),
                 {.ego = square,
                  .other = square,
                  .num_meetings = 400,
                  .num_samples = 4,
                  .num_beyond_samples = 2},
                 clock, [&](const std::string& what) { noted.push_back(what); });
  // x is drawn from -50 to 5 m, of which the table has 30 of 55 m; four standard deviations.
  EXPECT_NEAR(all.at("reach.risk_us.exact_share").get<double>(), 30.0 / 55.0, 0.1);
  EXPECT_NEAR(all.at("reach.risk_us.p50").get<double>(), 1000.0 / 16.0, 1e-9);
  EXPECT_NEAR(all.at("reach.risk_beyond_us.p99").get<double>(), 1000.0 / 16.0, 1e-9);
  EXPECT_EQ(all.size(), 5U);
  EXPECT_EQ(noted, std::vector<std::string>{"dangers"});
}

}  // namespace
}  // namespace saca::benchmarks::risk_times_test
