#include "saca/lab/learned_danger/state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace saca::learned_danger::state_test {
namespace {

const world::Footprint body{.length = 4.5, .width = 1.8, .centre_x = 0.2};

State driving(double speed) {
  State state;
  state.ego.v_B = {speed, 0.0};
  return state;
}

Obstacle car_at(Vec2 p, double yaw = 0.0, double speed = 0.0) {
  return {.body = {.length = 4.5, .width = 1.8}, .X_WO = {p, yaw}, .speed = speed};
}

// Bumper to bumper: 0.2 + 2.25 of the ego and 2.25 of the other.
TEST(State, IntrusionIsTheDeepestOfAll) {
  State state = driving(10.0);
  EXPECT_EQ(intrusion(body, state), -std::numeric_limits<double>::infinity());
  state.obstacles.push_back(car_at({14.7, 0.0}));
  EXPECT_NEAR(intrusion(body, state), -10.0, 1e-6);
  state.obstacles.push_back(car_at({0.2, 4.8}));
  EXPECT_NEAR(intrusion(body, state), -3.0, 1e-6);
  state.obstacles.push_back(car_at({4.2, 0.0}));
  EXPECT_NEAR(intrusion(body, state), 0.5, 1e-6);
}

TEST(State, IsSettledOnceNothingCanHappen) {
  State behind = driving(10.0);
  behind.obstacles.push_back(car_at({-20.0, 0.0}));
  EXPECT_TRUE(is_settled(body, behind));
  behind.obstacles[0].speed = 15.0;
  EXPECT_FALSE(is_settled(body, behind)) << "it comes from behind, and faster";
  State ahead = driving(10.0);
  ahead.obstacles.push_back(car_at({40.0, 0.0}));
  EXPECT_FALSE(is_settled(body, ahead));
  ahead.obstacles[0].speed = 10.0;
  EXPECT_TRUE(is_settled(body, ahead)) << "as fast: never nearer";
  ahead.obstacles[0].acceleration = -3.0;
  EXPECT_FALSE(is_settled(body, ahead));
  State at_rest = driving(0.0);
  at_rest.obstacles.push_back(car_at({6.0, 0.0}));
  EXPECT_TRUE(is_settled(body, at_rest));
  at_rest.obstacles[0].X_WO.p.x = 4.0;
  EXPECT_FALSE(is_settled(body, at_rest)) << "one stands in the other";
  at_rest.obstacles[0] = car_at({6.0, 0.0});
  at_rest.obstacles.push_back(car_at({0.0, -20.0}, 0.5 * std::numbers::pi, 5.0));
  EXPECT_FALSE(is_settled(body, at_rest)) << "the other one drives into it";
}

TEST(State, IsObservedFromTheEgo) {
  State state = driving(12.0);
  state.ego.X_WB = {{100.0, -50.0}, 0.5 * std::numbers::pi};
  state.obstacles.push_back(car_at({90.0, -20.0}, -0.5 * std::numbers::pi, 7.0));
  const Observation seen = observation(state);
  ASSERT_EQ(feature_names().size(), num_features);
  const auto of = [&](const std::string& name) {
    for (std::size_t i = 0; i < num_features; ++i) {
      if (feature_names()[i] == name) {
        return seen[i];
      }
    }
    ADD_FAILURE() << name;
    return 0.0F;
  };
  EXPECT_FLOAT_EQ(of("v_x"), 12.0F);
  EXPECT_FLOAT_EQ(of("grip"), 0.9F);
  EXPECT_FLOAT_EQ(of("obstacle0.there"), 1.0F);
  EXPECT_NEAR(of("obstacle0.x"), 30.0F, 1e-5) << "ahead";
  EXPECT_NEAR(of("obstacle0.y"), 10.0F, 1e-5) << "to the left";
  EXPECT_NEAR(of("obstacle0.cos_yaw"), -1.0F, 1e-6) << "oncoming";
  EXPECT_FLOAT_EQ(of("obstacle0.speed"), 7.0F);
  EXPECT_EQ(of("obstacle1.there"), 0.0F);
  EXPECT_EQ(of("obstacle2.length"), 0.0F);
}

// A pedestrian just before a fast car: a quarter of a second later it has passed.
TEST(State, IsNotSettledBeforeAShortBodyIsRunOver) {
  State state = driving(30.0);
  Obstacle pedestrian = car_at({2.25 + 0.5, 0.0}, 0.5 * std::numbers::pi, 0.0);
  pedestrian.body = {.length = 0.5, .width = 0.5};
  state.obstacles.push_back(pedestrian);
  EXPECT_FALSE(is_settled(body, state));
  state.obstacles[0].X_WO.p = {-3.0, 0.0};
  EXPECT_TRUE(is_settled(body, state)) << "behind";
  state.obstacles[0].X_WO.p = {0.0, 2.0};
  EXPECT_TRUE(is_settled(body, state)) << "beside: as far for a while, then farther";
}

TEST(State, TheMirrorTurnsSidesAround) {
  State state = driving(12.0);
  state.ego.X_WB = {{3.0, 4.0}, 0.3};
  state.ego.v_B.y = 0.5;
  state.ego.yaw_rate = 0.2;
  state.obstacles.push_back(car_at({20.0, 5.0}, 0.7, 9.0));
  state.obstacles[0].curvature = 0.02;
  const State other = mirrored(state);
  const Observation seen = observation(state);
  const Observation turned = observation(other);
  for (std::size_t i = 0; i < num_features; ++i) {
    const std::string& name = feature_names()[i];
    const bool turns = name == "v_y" || name == "yaw_rate" || name == "a_y" || name == "steering" ||
                       name == "obstacle0.y" || name == "obstacle0.sin_yaw" ||
                       name == "obstacle0.curvature";
    EXPECT_NEAR(turned[i], turns ? -seen[i] : seen[i], 1e-5) << name;
  }
  EXPECT_NEAR(intrusion(body, other), intrusion(body, state), 1e-9);
  EXPECT_EQ(observation(mirrored(other)), seen);
}

// In the obstacle's frame, which moves along its x.
TEST(State, MeetsOneObstacleAsTheAvoidanceProblemHasIt) {
  State state = driving(12.0);
  state.ego.v_B.y = 12.0;  // slides at 45 degrees
  const Obstacle obstacle = car_at({30.0, 10.0}, 0.5 * std::numbers::pi, 6.0);
  const danger::Meeting meeting = meeting_of(body, state, obstacle);
  EXPECT_NEAR(meeting.state[0], -10.0, 1e-9);
  EXPECT_NEAR(meeting.state[1], 30.0, 1e-9);
  EXPECT_NEAR(meeting.state[2], -0.25 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(meeting.state[3], 12.0 * std::numbers::sqrt2, 1e-9);
  EXPECT_EQ(meeting.obstacle_speed, 6.0);
}

}  // namespace
}  // namespace saca::learned_danger::state_test
