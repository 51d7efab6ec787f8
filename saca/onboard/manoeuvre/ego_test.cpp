#include "saca/onboard/manoeuvre/ego.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::manoeuvre::ego_test {
namespace {

using vehicle::VehicleState;

class Ego : public testing::Test {
 protected:
  static world::EgoState moving(Vec2 v_B, double yaw_rate, Vec2 a_B) {
    return {.X_WB = {{3.0, 4.0}, 1.0}, .v_B = v_B, .yaw_rate = yaw_rate, .a_B = a_B};
  }

  // The state after `seconds` in which whoever drives holds what the state shows.
  [[nodiscard]] VehicleState held(VehicleState state, double seconds) const {
    const vehicle::Command command{.steering = state.steering,
                                   .brake_torque = state.brake_torque,
                                   .motor_torque = state.motor_torque};
    for (int i = 0; i < std::lround(seconds / 1e-3); ++i) {
      state = vehicle::step(car_, state, command, 0.9, 1e-3);
    }
    return state;
  }

  const Car car_ = prepare::default_car();
};

TEST_F(Ego, RollsOnStraight) {
  const world::EgoState ego = moving({15.0, 0.0}, 0.0, {});
  const VehicleState end = held(rolling_state(car_, ego, 0.9), 0.2);
  EXPECT_NEAR(end.v_B.x, 15.0, 0.02);  // air drag takes 0.01
  EXPECT_NEAR(end.X_WB.p.x, 3.0 + 3.0 * std::cos(1.0), 0.01);
  EXPECT_NEAR(end.yaw_rate, 0.0, 1e-9);
}

TEST_F(Ego, GoesOnBrakingAsItDid) {
  const world::EgoState ego = moving({15.0, 0.0}, 0.0, {-4.0, 0.0});
  const VehicleState end = held(rolling_state(car_, ego, 0.9), 0.2);
  EXPECT_NEAR(end.v_B.x, 15.0 - 0.8, 0.05);
  EXPECT_NEAR(end.a_B.x, -4.0, 0.2);
}

TEST_F(Ego, GoesOnAcceleratingAsItDid) {
  const world::EgoState ego = moving({10.0, 0.0}, 0.0, {2.0, 0.0});
  const VehicleState end = held(rolling_state(car_, ego, 0.9), 0.2);
  EXPECT_NEAR(end.v_B.x, 10.4, 0.05);
}

TEST_F(Ego, GoesOnTurningAsItDid) {
  // 0.25 rad/s at 16 m/s: 4 m/s^2. Sideslip of a neutral car: l_r r / v less the rear tyres' slip,
  // a / (stiffness g) = 0.0227 - 4 / (18 x 9.81) = 0.0000.
  const world::EgoState ego = moving({16.0, 0.0}, 0.25, {0.0, 4.0});
  const VehicleState end = held(rolling_state(car_, ego, 0.9), 0.3);
  EXPECT_NEAR(end.yaw_rate, 0.25, 0.03);
}

TEST_F(Ego, ComesBackFromTheCarsState) {
  const world::EgoState ego = moving({12.0, -0.1}, 0.1, {-1.0, 1.2});
  const world::EgoState back = ego_state(rolling_state(car_, ego, 0.9));
  EXPECT_EQ(back.X_WB.p.x, 3.0);
  EXPECT_EQ(back.v_B.y, -0.1);
  EXPECT_EQ(back.yaw_rate, 0.1);
  EXPECT_EQ(back.a_B.x, -1.0);
}

TEST_F(Ego, AtRestIsAtRest) {
  EXPECT_TRUE(vehicle::at_rest(rolling_state(car_, {}, 0.9)));
}

TEST_F(Ego, CoversTheGroundOfItsBody) {
  const world::Footprint body = footprint(car_);
  EXPECT_EQ(body.shape, world::Shape::box);
  EXPECT_DOUBLE_EQ(body.centre_x + 0.5 * body.length, 2.25);  // front bumper
  EXPECT_DOUBLE_EQ(body.centre_x - 0.5 * body.length, 2.25 - 4.7);
}

TEST_F(Ego, RefusesWhatIsNotFinite) {
  world::EgoState ego;
  ego.a_B.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)rolling_state(car_, ego, 0.9), ContractViolation);
}

}  // namespace
}  // namespace saca::manoeuvre::ego_test
