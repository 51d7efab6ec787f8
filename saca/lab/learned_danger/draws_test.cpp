#include "saca/lab/learned_danger/draws.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/learned_danger/arc_evasions.h"
#include "saca/lab/learned_danger/ego.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger::draws_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

class Draws : public testing::Test {
 protected:
  const manoeuvre::Car car_ = prepare::default_car();
  std::mt19937_64 random_{11};
};

TEST_F(Draws, StartsMoveInAllWaysAndNoneSpins) {
  int turning = 0;
  int braking = 0;
  double left = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Ego ego = ego_of(car_, drawn_start(car_, 0.7, random_));
    ASSERT_TRUE(is_finite(ego.X_WB));
    ASSERT_LE(norm(ego.v_B), 45.0);
    turning += std::abs(ego.yaw_rate) > 0.05 ? 1 : 0;
    braking += ego.braking > 0.5 ? 1 : 0;
    left += ego.yaw_rate > 0.0 ? 1.0 : -1.0;
  }
  EXPECT_GT(turning, 100);
  EXPECT_GT(braking, 60);
  EXPECT_LT(std::abs(left), 60.0) << "to either side alike";
}

TEST_F(Draws, ObstaclesAreAsBodiesAre) {
  int standing = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Obstacle obstacle = drawn_obstacle(random_);
    standing += obstacle.speed == 0.0 ? 1 : 0;
    EXPECT_GE(obstacle.body.length, obstacle.body.width * 0.8);
    EXPECT_LE(obstacle.body.length, 18.2);
    const double across = obstacle.curvature * obstacle.speed * obstacle.speed;
    EXPECT_LE(std::abs(across), 6.0 + 1e-9);
    if (obstacle.speed == 0.0) {
      EXPECT_EQ(obstacle.acceleration, 0.0) << "who stands stays";
    }
  }
  EXPECT_NEAR(standing / 2'000.0, 0.3, 0.04);
}

TEST_F(Draws, NobodyStandsInTheEgo) {
  State state;
  state.ego.X_WB = {{5.0, -3.0}, 2.0};
  state.ego.v_B = {20.0, 0.0};
  for (int i = 0; i < 500; ++i) {
    const Obstacle placed = placed_anywhere(body, state, drawn_obstacle(random_), random_);
    EXPECT_LT(danger::intrusion(body, state.ego.X_WB, placed.body, placed.X_WO), 0.0);
    EXPECT_LE(norm(placed.X_WO.p - state.ego.X_WB.p), 110.0);
  }
}

// A value whose boundary is known: half the gap along the bearing to a circle of 30 m.
TEST_F(Draws, NearTheBoundaryIsWithinTwoMetres) {
  State state;
  state.ego.v_B = {20.0, 0.0};
  const auto value = [&](const Obstacle& obstacle) {
    return 0.5 * (30.0 - norm(obstacle.X_WO.p - state.ego.X_WB.p));
  };
  const CanStayBelow by_value = [&](double level, const Obstacle& obstacle) {
    return value(obstacle) <= level;
  };
  double least = 0.0;
  double most = 0.0;
  for (int i = 0; i < 300; ++i) {
    const auto placed =
        placed_near_boundary(body, state, drawn_obstacle(random_), by_value, random_);
    ASSERT_TRUE(placed.has_value());
    EXPECT_LE(std::abs(value(*placed)), 2.1);
    least = std::min(least, value(*placed));
    most = std::max(most, value(*placed));
  }
  EXPECT_LT(least, -1.8);
  EXPECT_GT(most, 1.8);
  const CanStayBelow never = [](double /*level*/, const Obstacle& /*obstacle*/) { return false; };
  EXPECT_FALSE(placed_near_boundary(body, state, drawn_obstacle(random_), never, random_));
}

// By arcs, measured with other evasions (danger/danger.h).
TEST_F(Draws, NearTheBoundaryOfTheAvoidanceProblem) {
  const danger::Avoidance limits = danger::avoidance_of(car_, 0.9);
  const danger::DangerModel model(limits, body, {});
  State state;
  state.grip = 0.9;
  state.ego.v_B = {20.0, 0.0};
  const ArcEvasions arcs(limits, body, state);
  const CanStayBelow by_arcs = [&](double level, const Obstacle& obstacle) {
    return arcs.stay_below(level, obstacle);
  };
  int placed = 0;
  int near = 0;
  for (int i = 0; i < 200; ++i) {
    Obstacle obstacle = drawn_obstacle(random_);
    obstacle.acceleration = 0.0;
    obstacle.curvature = 0.0;
    const auto there = placed_near_boundary(body, state, obstacle, by_arcs, random_);
    placed += there ? 1 : 0;
    near += there && std::abs(model.danger(meeting_of(body, state, *there)).value) <= 2.5 ? 1 : 0;
  }
  EXPECT_GT(placed, 80);
  EXPECT_GT(near, placed * 9 / 10);
}

}  // namespace
}  // namespace saca::learned_danger::draws_test
