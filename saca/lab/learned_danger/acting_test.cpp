#include "saca/lab/learned_danger/acting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/world/scene.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger::acting_test {
namespace {

using manoeuvre::Demand;

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

/// A network whose Q falls with one of the two numbers of a demand, and whose V adds `v` to h.
Network preferring(std::size_t number, double sign) {
  formats::Tensors all = networks_that_hand_on();
  for (const std::string name : {"v.", "q1.", "q2."}) {
    if (name != "v.") {
      all.tensors.at(name + "0.weight").values[num_net_inputs + number] = static_cast<float>(sign);
    }
    all.tensors.at(name + "0.bias").values[0] = 2.0F;
  }
  return Network::from(all, "weights").value();
}

class Acting : public testing::Test {
 protected:
  /// At a speed, so far from the rear of a car that stands ahead.
  [[nodiscard]] Situation before_a_car(double speed, double gap) const {
    Situation situation;
    situation.grip = 0.9;
    situation.car =
        manoeuvre::rolling_state(car_, world::EgoState{.v_B = {speed, 0.0}}, situation.grip);
    Obstacle ahead;
    ahead.body = {.length = 4.5, .width = 1.8};
    ahead.X_WO = situation.car.X_WB * Pose{{0.1 + 2.15 + gap + 2.25, 0.0}, 0.0};
    situation.obstacles.push_back(ahead);
    return situation;
  }

  const manoeuvre::Car car_ = prepare::default_car();
};

TEST_F(Acting, TakesTheDemandOfLeastQ) {
  const State state = state_of(car_, before_a_car(20.0, 30.0));
  const Demand braking = least_q(preferring(0, 1.0), body, state);
  EXPECT_NEAR(braking.along, -1.0, 1e-12);
  EXPECT_NEAR(braking.across, 0.0, 1e-12);
  EXPECT_NEAR(least_q(preferring(1, -1.0), body, state).across, 1.0, 1e-12);
  EXPECT_THROW(std::ignore = least_q(preferring(0, 1.0), body, State{}), ContractViolation);
}

// All layers hand on 2: V adds log(1 + e^2) to h, of the nearer obstacle.
TEST_F(Acting, TellsTheHighestOfTheObstacles) {
  State state = state_of(car_, before_a_car(20.0, 10.0));
  state.obstacles.push_back(state_of(car_, before_a_car(20.0, 4.0)).obstacles[0]);
  EXPECT_NEAR(joint_v(preferring(0, 1.0), body, state), -4.0 + std::log1p(std::exp(2.0)), 1e-3);
  EXPECT_EQ(highest_single_v(preferring(0, 1.0), body, state),
            joint_v(preferring(0, 1.0), body, state));
}

// From 15 m/s on grip 0.9 a point mass stops within 12.74 m; 1 m and 0.2 s of the way are to be
// left.
TEST_F(Acting, EvadesStraightWhereThatLeavesRoom) {
  const danger::Avoidance limits = danger::avoidance_of(car_, 1.0);
  const Network to_the_left = preferring(1, -1.0);
  const auto before = [&](double gap) { return state_of(car_, before_a_car(15.0, gap)); };
  const auto braking = straight_evasion(limits, body, before(16.8));
  ASSERT_TRUE(braking.has_value());
  EXPECT_NEAR(braking->along, -1.0, 1e-9);
  EXPECT_NEAR(braking->across, 0.0, 1e-9);
  EXPECT_EQ(evasion(limits, to_the_left, body, before(16.8)).along, braking->along);
  EXPECT_FALSE(straight_evasion(limits, body, before(16.6)).has_value());
  EXPECT_NEAR(evasion(limits, to_the_left, body, before(16.6)).across, 1.0, 1e-12) << "by Q";

  State aside = before(8.0);
  aside.obstacles[0].X_WO.p.y += 1.8 + 4.05;
  const auto going_on = straight_evasion(limits, body, aside);
  ASSERT_TRUE(going_on.has_value());
  EXPECT_EQ(going_on->along, 0.0);
  EXPECT_EQ(going_on->across, 0.0);

  State from_behind = before(16.8);
  from_behind.obstacles.push_back(from_behind.obstacles[0]);
  from_behind.obstacles[1].X_WO = {{-10.0, 0.0}, 0.0};
  from_behind.obstacles[1].speed = 20.0;
  EXPECT_FALSE(straight_evasion(limits, body, from_behind).has_value())
      << "whoever brakes is run into";
}

// Full braking from 15 m/s on grip 0.9 takes some 13 to 16 m; a car that only rolls hits.
TEST_F(Acting, DrivesTheFullVehicleToTheEnd) {
  const Policy braking = [](const State& /*state*/, double /*time*/) { return Demand{-1.0, 0.0}; };
  const Policy rolling = [](const State& /*state*/, double /*time*/) { return Demand{}; };
  const double stopped = highest_h(car_, body, before_a_car(15.0, 20.0), braking);
  EXPECT_GT(stopped, -7.5);
  EXPECT_LT(stopped, -3.0);
  EXPECT_NEAR(highest_h(car_, body, before_a_car(15.0, 25.0), braking), stopped - 5.0, 1e-3);
  EXPECT_GT(highest_h(car_, body, before_a_car(15.0, 20.0), rolling), 0.8);
  EXPECT_GT(highest_h(car_, body, before_a_car(15.0, 8.0), braking), 0.0);
}

}  // namespace
}  // namespace saca::learned_danger::acting_test
