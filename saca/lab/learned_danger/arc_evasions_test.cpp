#include "saca/lab/learned_danger/arc_evasions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "saca/lab/learned_danger/draws.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger::arc_evasions_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};
const danger::Avoidance limits{
    .grip = 1.0, .tightest_curvature = 0.2, .drive_share = 0.4, .obstacle_speed = 0.0};

State moving(double speed, double grip = 0.9) {
  State state;
  state.grip = grip;
  state.ego.X_WB = {{3.0, -2.0}, 0.7};
  state.ego.v_B = {speed, 0.0};
  return state;
}

/// Across the ego's way, its middle so far ahead of the ego's centre of mass.
Obstacle wall(const State& state, double ahead) {
  Obstacle obstacle;
  obstacle.body = {.length = 1.0, .width = 200.0};
  obstacle.X_WO = state.ego.X_WB * Pose{{ahead, 0.0}, 0.0};
  return obstacle;
}

// Nobody turns away within what it takes to stop: before a wall it is v^2 / (2 mu g).
TEST(ArcEvasions, BeforeAWallTheWayOfBrakingCounts) {
  for (const double speed : {10.0, 20.0, 30.0}) {
    for (const double grip : {0.3, 0.9}) {
      const State state = moving(speed, grip);
      const ArcEvasions arcs(limits, body, state);
      const double way = speed * speed / (2.0 * grip * vehicle::gravity);
      const double room = 0.5;
      const Obstacle obstacle = wall(state, way + 0.1 + 2.15 + room + 0.5);
      const auto best = arcs.best(obstacle);
      EXPECT_NEAR(best.highest, -room, 0.06);
      EXPECT_NEAR(best.demand.along, -1.0, 1e-9);
      EXPECT_TRUE(arcs.stay_below(-room + 0.06, obstacle));
      EXPECT_FALSE(arcs.stay_below(-room - 0.06, obstacle));
    }
  }
}

// A narrow one at speed is passed, not braked for; who does not move cannot do anything.
TEST(ArcEvasions, TurnsAwayWhereBrakingIsTooLate) {
  const State state = moving(35.0);
  Obstacle post = wall(state, 35.0);
  post.body = {.length = 0.5, .width = 0.5};
  post.X_WO.p = post.X_WO.p + rotated(Vec2{0.0, 0.5}, post.X_WO.yaw);
  const auto best = ArcEvasions(limits, body, state).best(post);
  EXPECT_LT(best.highest, 0.0);
  EXPECT_LT(best.demand.across, -0.5) << "it stands to the left";

  const State at_rest = moving(0.0);
  Obstacle coming = wall(at_rest, 30.0);
  coming.X_WO.yaw += std::acos(-1.0);
  coming.speed = 5.0;
  EXPECT_GT(ArcEvasions(limits, body, at_rest).best(coming).highest, 0.5);
  coming.acceleration = -1.0;
  EXPECT_NEAR(ArcEvasions(limits, body, at_rest).best(coming).highest, 12.5 + 0.5 + 2.25 - 30.0,
              0.2);
}

class ArcsBesideDraws : public testing::Test {
 protected:
  /// Beside what keeps its velocity, or anything.
  [[nodiscard]] Obstacle drawn(const State& state, bool keeps_on) {
    Obstacle obstacle = drawn_obstacle(random_);
    if (keeps_on) {
      obstacle.acceleration = 0.0;
      obstacle.curvature = 0.0;
    }
    return placed_anywhere(body, state, obstacle, random_);
  }
  std::mt19937_64 random_{17};
};

// The product's own few evasions hold an acceleration along and across, not an arc, and are met
// every 0.1 s: near what these leave, to either side.
TEST_F(ArcsBesideDraws, AreAsGoodAsOtherFewEvasions) {
  const danger::DangerModel model(limits, body, {});
  double sum = 0.0;
  int seen = 0;
  int worse = 0;
  for (int i = 0; i < 200; ++i) {
    const State state = moving(uniform(random_, 5.0, 35.0), uniform(random_, 0.3, 1.0));
    const Obstacle obstacle = drawn(state, true);
    const double here = ArcEvasions(limits, body, state).best(obstacle).highest;
    const double there = model.danger(meeting_of(body, state, obstacle)).value;
    if (std::abs(there) > 5.0) {
      continue;
    }
    ++seen;
    sum += here - there;
    worse += here > there + 1.0 ? 1 : 0;
  }
  ASSERT_GT(seen, 25);
  EXPECT_NEAR(sum / seen, 0.0, 0.3);
  EXPECT_LT(worse, seen / 5);
}

// The way is met in steps as long as h allows; here in steps of 5 ms.
TEST_F(ArcsBesideDraws, MissNothingOnTheWay) {
  for (int i = 0; i < 100; ++i) {
    const State state = moving(uniform(random_, 0.0, 35.0), uniform(random_, 0.3, 1.0));
    const Obstacle obstacle = drawn(state, false);
    const ArcEvasions arcs(limits, body, state);
    const auto best = arcs.best(obstacle);
    const double speed = norm(state.ego.v_B);
    const double most = state.grip * vehicle::gravity;
    Obstacle ego;
    ego.X_WO = state.ego.X_WB;
    ego.speed = speed;
    ego.acceleration = best.demand.along * most;
    ego.curvature = speed > 0.0 ? best.demand.across * most / (speed * speed) : 0.0;
    double highest = -1e9;
    for (int k = 0; k < 3'200; ++k) {
      const double time = 0.005 * k;
      const Obstacle then = after(obstacle, time);
      highest =
          std::max(highest, danger::intrusion(body, after(ego, time).X_WO, then.body, then.X_WO));
    }
    EXPECT_LE(best.highest, highest + 0.02);
    EXPECT_NEAR(best.highest, highest, 0.25 + 0.1 * std::abs(highest));
    EXPECT_TRUE(arcs.stay_below(highest + 0.02, obstacle));
    EXPECT_FALSE(arcs.stay_below(highest - 0.3 - 0.1 * std::abs(highest), obstacle));
  }
}

TEST_F(ArcsBesideDraws, AreMirrored) {
  for (int i = 0; i < 50; ++i) {
    State state = moving(uniform(random_, 0.0, 35.0));
    state.obstacles.push_back(drawn(state, false));
    const State other = mirrored(state);
    const auto best = ArcEvasions(limits, body, state).best(state.obstacles[0]);
    const auto there = ArcEvasions(limits, body, other).best(other.obstacles[0]);
    EXPECT_NEAR(best.highest, there.highest, 1e-6);
  }
}

}  // namespace
}  // namespace saca::learned_danger::arc_evasions_test
