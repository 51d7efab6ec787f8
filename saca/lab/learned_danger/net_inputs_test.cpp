#include "saca/lab/learned_danger/net_inputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/draws.h"

namespace saca::learned_danger::net_inputs_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

State drawn(Random& random) {
  State state;
  state.grip = uniform(random, 0.2, 1.0);
  Ego& ego = state.ego;
  ego.X_WB = {{uniform(random, -500.0, 500.0), 80.0}, uniform(random, -3.0, 3.0)};
  ego.v_B = {uniform(random, 0.0, 40.0), uniform(random, -2.0, 2.0)};
  ego.yaw_rate = uniform(random, -0.6, 0.6);
  ego.a_B = {uniform(random, -9.0, 3.0), uniform(random, -9.0, 9.0)};
  ego.steering = uniform(random, -0.3, 0.3);
  ego.braking = uniform(random, 0.0, 9.0);
  state.obstacles.push_back(placed_anywhere(body, state, drawn_obstacle(random), random));
  return state;
}

// Two cars in line, 20 m between their ends, the ego 10 m/s faster: what the numbers must be.
TEST(NetInputs, AreWhatTheySay) {
  State state;
  state.grip = 0.5;
  state.ego.X_WB = {{3.0, 4.0}, 1.0};
  state.ego.v_B = {20.0, 0.0};
  Obstacle ahead;
  ahead.body = {.length = 4.0, .width = 1.8};
  ahead.X_WO = state.ego.X_WB * Pose{{0.1 + 2.15 + 20.0 + 2.0, 0.0}, 0.0};
  ahead.speed = 10.0;
  state.obstacles.push_back(ahead);
  const SeenByNet seen = seen_by_net(body, observation(state), 0);
  EXPECT_NEAR(seen.h, -20.0, 1e-4);
  EXPECT_NEAR(seen.inputs[0], 1.0, 1e-6);
  EXPECT_NEAR(seen.inputs[8], 0.5, 1e-6);
  EXPECT_NEAR(seen.inputs[15], -0.5, 1e-6) << "it comes nearer";
  EXPECT_NEAR(seen.inputs[22], -2.0, 1e-4);
  EXPECT_NEAR(seen.inputs[24], -1.5, 1e-4) << "5 m nearer in half a second";
  EXPECT_NEAR(seen.inputs[25], -1.0, 1e-4);
  EXPECT_GE(seen.inputs[26], -0.05) << "they touch after two";
  EXPECT_NEAR(seen.inputs[27], 2.425 / 3.0, 1e-4);
  EXPECT_NEAR(seen.inputs[28], 0.0, 1e-6);
  EXPECT_NEAR(seen.inputs[29], 400.0 / (2.0 * 0.5 * 9.80665) / 30.0, 1e-3);
  EXPECT_NEAR(seen.inputs[30], 100.0 / (2.0 * 20.0 * 0.5 * 9.80665), 1e-3);
  const double gap = 20.0 - 10.0 * 0.8 + 0.5 * 0.5 * 9.80665 * 0.8 * 0.8;
  EXPECT_NEAR(seen.inputs[32], -0.1 * gap, 1e-4) << "after braking for 0.8 s";
  EXPECT_NEAR(seen.inputs[34], 0.0, 1e-5) << "left is as good as right";
  EXPECT_NEAR(seen.inputs[36], 0.0, 1e-5);
}

TEST(NetInputs, ChangeTheirSignInAMirrorWhereTheySay) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const State state = drawn(random);
    SeenByNet seen = seen_by_net(body, observation(state), 0);
    const SeenByNet other = seen_by_net(body, observation(mirrored(state)), 0);
    EXPECT_NEAR(seen.h, other.h, 1e-4);
    for (const std::size_t k : mirrored_inputs()) {
      seen.inputs[k] = -seen.inputs[k];
    }
    for (std::size_t k = 0; k < num_net_inputs; ++k) {
      EXPECT_NEAR(seen.inputs[k], other.inputs[k], 1e-3) << k;
    }
  }
}

TEST(NetInputs, AreFiniteAndAboutAsLargeAsOne) {
  Random random(4);
  std::array<double, num_net_inputs> squares{};
  constexpr int count = 2'000;
  for (int i = 0; i < count; ++i) {
    const SeenByNet seen = seen_by_net(body, observation(drawn(random)), 0);
    for (std::size_t k = 0; k < num_net_inputs; ++k) {
      ASSERT_TRUE(std::isfinite(seen.inputs[k]));
      ASSERT_LE(std::abs(seen.inputs[k]), 12.0F) << k;
      const double input = static_cast<double>(seen.inputs[k]);
      squares[k] += input * input / count;
    }
  }
  for (std::size_t k = 0; k < num_net_inputs; ++k) {
    EXPECT_LT(std::sqrt(squares[k]), 5.0) << k;
    EXPECT_TRUE(std::sqrt(squares[k]) > 0.05 || k == 7) << k << ": the motor is not drawn here";
  }
}

TEST(NetInputs, WantAnObstacle) {
  const State state;
  EXPECT_THROW(std::ignore = seen_by_net(body, observation(state), 0), ContractViolation);
  EXPECT_THROW(std::ignore = seen_by_net(body, observation(state), 3), ContractViolation);
}

}  // namespace
}  // namespace saca::learned_danger::net_inputs_test
