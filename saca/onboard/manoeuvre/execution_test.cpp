#include "saca/onboard/manoeuvre/execution.h"

#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::execution_test {
namespace {

constexpr double dt = vehicle::usual_step;  // [s]
constexpr double grip = 0.9;

const Car& car() {
  static const Car the_car = prepare::default_car();
  return the_car;
}

/// Drives on until the plan has reached its end, 10 s at most.
/// @return  where the car is then
vehicle::VehicleState driven(Execution& execution, vehicle::VehicleState state) {
  for (int k = 0; k < 10'000 && !execution.finished(); ++k) {
    state = vehicle::step(car(), state, execution.control(state, grip, dt), grip, dt);
  }
  return state;
}

vehicle::VehicleState rolling(double speed) {
  return rolling_state(car(), test::ego_alone(speed, grip).ego, grip);
}

// What forecasts are made with (manoeuvre::drive) is what is carried out.
TEST(Execution, DrivesAsForecastsDo) {
  const world::Scene scene = test::ego_alone(16.0, grip);
  for (const PolicyId policy : all_policies) {
    if (policy == PolicyId::no_intervention) {
      continue;  // never ends
    }
    const Plan plan = default_plan(policy, 16.0);
    Execution execution(car(), plan, scene);
    EXPECT_EQ(execution.plan(), plan);
    EXPECT_EQ(execution.refused(), std::nullopt);
    const vehicle::VehicleState end = driven(execution, rolling(16.0));
    EXPECT_TRUE(execution.finished());
    const EgoMotion forecast = drive(car(), plan, scene, grip, 10.0);
    // To the 10 ms in which the forecast notices the end.
    EXPECT_NEAR(end.X_WB.p.x, forecast.track.X_WA.back().p.x, 0.17) << name(policy);
    EXPECT_NEAR(end.X_WB.p.y, forecast.track.X_WA.back().p.y, 0.01) << name(policy);
    EXPECT_NEAR(end.v_B.x, forecast.v_B.back().x, 0.1) << name(policy);
  }
}

TEST(Execution, WhatCannotBeDrivenGivesWayToFullBraking) {
  Execution execution(car(), {PolicyId::t_drift_left, std::nullopt}, test::ego_alone(4.0, grip));
  EXPECT_EQ(execution.plan(), full_braking);
  EXPECT_EQ(execution.refused(), Refusal::speed);
  EXPECT_LT(driven(execution, rolling(4.0)).v_B.x, 0.1);
}

// The scene says 60 m/s. Full braking from 12 m/s takes 9.53 m, deployed at most 12 % more
// (docs/architecture.md).
TEST(Execution, BrakesBeginWithTheSpeedThatTheCarMeasures) {
  Execution execution(car(), full_braking, test::ego_alone(60.0, grip));
  EXPECT_LT(driven(execution, rolling(12.0)).X_WB.p.x, 1.12 * 9.53);
}

// A lane has been recovered, and is kept.
TEST(Execution, WhatHasReachedItsEndGoesOn) {
  Execution execution(car(), {PolicyId::aes_left, std::nullopt}, test::ego_alone(16.0, grip));
  vehicle::VehicleState state = driven(execution, rolling(16.0));
  for (int k = 0; k < 2'000; ++k) {
    state = vehicle::step(car(), state, execution.control(state, grip, dt), grip, dt);
  }
  EXPECT_TRUE(execution.finished());
  EXPECT_NEAR(state.X_WB.p.y, world::Road{}.lane_width, 0.2);
  EXPECT_NEAR(state.v_B.x, 16.0, 1.0);
}

TEST(Execution, ACopyGoesOnByItself) {
  Execution execution(car(), full_braking, test::ego_alone(12.0, grip));
  Execution copy = execution;
  const double way = driven(execution, rolling(12.0)).X_WB.p.x;
  EXPECT_FALSE(copy.finished());
  EXPECT_EQ(driven(copy, rolling(12.0)).X_WB.p.x, way);
}

}  // namespace
}  // namespace saca::manoeuvre::execution_test
