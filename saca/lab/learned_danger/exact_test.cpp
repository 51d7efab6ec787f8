#include "saca/lab/learned_danger/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "saca/lab/learned_danger/table_for_test.h"

namespace saca::learned_danger::exact_test {
namespace {

const SquareAtRest& solved() {
  static const SquareAtRest one;
  return one;
}

/// Towards the square, whose centre is `ahead` and `left` of the ego's [m].
State state_before(double ahead, double left, double speed) {
  State state{.ego = {.v_B = {speed, 0.0}}, .grip = 0.9};
  state.obstacles.push_back({.body = solved().square, .X_WO = {{ahead, left}, 0.0}});
  return state;
}

std::optional<manoeuvre::Demand> best(const State& state) {
  return exact_best(solved().model, solved().limits, solved().ego, state, state.obstacles[0]);
}

TEST(Exact, BrakesOrTurnsAwayFromWhatStandsAhead) {
  const State ahead = state_before(7.0, 0.3, 9.0);
  ASSERT_TRUE(exact_value(solved().model, solved().ego, ahead, ahead.obstacles[0]).has_value());
  const auto demand = best(ahead);
  ASSERT_TRUE(demand.has_value());
  EXPECT_LT(demand->along, 0.3) << "it does not drive on";
  EXPECT_GT(std::hypot(demand->along, demand->across), 0.9) << "with all the grip";
}

TEST(Exact, TurnsToTheOtherSideInAMirror) {
  const auto right = best(state_before(9.0, 0.9, 12.0));
  const auto left = best(state_before(9.0, -0.9, 12.0));
  ASSERT_TRUE(right.has_value() && left.has_value());
  EXPECT_LT(right->across, 0.0) << "away from what stands to the left";
  EXPECT_NEAR(left->across, -right->across, 1e-9);
  EXPECT_NEAR(left->along, right->along, 1e-9);
}

TEST(Exact, KnowsNothingOfWhatDoesNotKeepItsVelocity) {
  State state = state_before(7.0, 0.0, 9.0);
  state.obstacles[0].speed = 3.0;
  state.obstacles[0].acceleration = -1.0;
  EXPECT_FALSE(best(state).has_value());
  state.obstacles[0].acceleration = 0.0;
  state.obstacles[0].curvature = 0.05;
  EXPECT_FALSE(exact_value(solved().model, solved().ego, state, state.obstacles[0]).has_value());
}

}  // namespace
}  // namespace saca::learned_danger::exact_test
