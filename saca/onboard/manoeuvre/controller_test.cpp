#include "saca/onboard/manoeuvre/controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::controller_test {
namespace {

constexpr double dt = 1e-3;

class Controller : public testing::Test {
 protected:
  const Car car_ = prepare::default_car();
};

TEST_F(Controller, AllocatesNothingAndNeitherDoesTheCar) {
  const world::Scene scene = test::ego_alone(14.0, 0.9);
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::es_b_left, PolicyId::no_intervention}) {
    const Plan plan = default_plan(policy, 14.0);
    ControllerState memory = begin(car_, plan, scene);
    vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.9);
    bool ended = false;
    const std::size_t before = num_allocations;
    for (int i = 0; i < 500; ++i) {
      state =
          vehicle::step(car_, state, control(car_, scene.road, 0.9, state, memory, dt), 0.9, dt);
      ended = ended || finished(state, memory);
    }
    EXPECT_EQ(num_allocations - before, 0U);
    EXPECT_FALSE(ended);
  }
  static_assert(noexcept(control(car_, scene.road, 0.9, vehicle::VehicleState{},
                                 std::declval<ControllerState&>(), dt)));
}

// One physics, one controller: the simulator's loop and `drive` give the same motion.
TEST_F(Controller, StepByStepIsDrive) {
  const world::Scene scene = test::ego_alone(17.0, 0.6);
  const Plan plan = default_plan(PolicyId::es_b_right, 17.0);
  const EgoMotion motion = drive(car_, plan, scene, 0.6, 1.0);
  ControllerState memory = begin(car_, plan, scene);
  vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.6);
  for (int i = 0; i < 1000; ++i) {
    state = vehicle::step(car_, state, control(car_, scene.road, 0.6, state, memory, dt), 0.6, dt);
  }
  EXPECT_EQ(state.X_WB.p.x, motion.track.X_WA.back().p.x);
  EXPECT_EQ(state.X_WB.yaw, motion.track.X_WA.back().yaw);
}

TEST_F(Controller, KeepsTheNewLaneAfterItsEnd) {
  const world::Scene scene = test::ego_alone(14.0, 0.9);
  const Plan plan{PolicyId::aes_left, {}};
  ControllerState memory = begin(car_, plan, scene);
  vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.9);
  for (int i = 0; i < 8000; ++i) {
    state = vehicle::step(car_, state, control(car_, scene.road, 0.9, state, memory, dt), 0.9, dt);
  }
  EXPECT_TRUE(finished(state, memory));
  EXPECT_NEAR(state.X_WB.p.y, 3.5, 0.02);
  EXPECT_NEAR(state.X_WB.yaw, 0.0, 1e-3);
  EXPECT_NEAR(state.v_B.x, 14.0, 0.1);
}

// The wheels' forces, all together, stay inside the circle that the road gives; steering has its
// part first, so the lane is changed as planned while the brakes take the rest.
TEST_F(Controller, UsesTheCircleWithoutLeavingIt) {
  const world::Scene scene = test::ego_alone(20.0, 0.8);
  const Plan plan = default_plan(PolicyId::es_b_left, 20.0);
  ControllerState memory = begin(car_, plan, scene);
  vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.8);
  double most = 0.0;
  double deepest_slip = 0.0;
  for (int i = 0; i < 2500; ++i) {
    state = vehicle::step(car_, state, control(car_, scene.road, 0.8, state, memory, dt), 0.8, dt);
    most = std::max(most, norm(state.a_B) / (0.8 * vehicle::gravity));
    for (const vehicle::WheelContact& wheel : vehicle::contacts(car_, state, 0.8)) {
      EXPECT_LE(norm(wheel.F_T), wheel.peak_force * (1.0 + 1e-12));
      deepest_slip = std::max(deepest_slip, wheel.slip);
    }
  }
  EXPECT_GT(most, 0.8);
  EXPECT_LT(most, 1.02);  // air drag comes on top of the tyres
  // Below the peak of the curve: no wheel slides.
  EXPECT_LT(deepest_slip, vehicle::slip_for(car_.tyre, 0.8, 1.0));
}

TEST_F(Controller, BrakesHardAndStraightWhenItsSensorsFail) {
  const world::Scene scene = test::ego_alone(14.0, 0.9);
  const Plan plan{PolicyId::aes_left, {}};
  ControllerState memory = begin(car_, plan, scene);
  vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.9);
  state.v_B.y = std::numeric_limits<double>::quiet_NaN();
  const vehicle::Command command = control(car_, scene.road, 0.9, state, memory, dt);
  EXPECT_EQ(command.steering, 0.0);
  EXPECT_EQ(command.motor_torque, 0.0);
  EXPECT_GT(command.brake_torque[vehicle::rear_left], 0.0);
}

// One wrong sample of one wheel, or all of them, in the middle of a stop: the brakes go on.
TEST_F(Controller, AWheelWhoseSensorFailsIsTakenToRoll) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const world::Scene scene = test::ego_alone(14.0, 0.9);
  std::optional<double> unharmed;
  for (const std::size_t num_failed : {std::size_t{0}, std::size_t{1}, vehicle::num_wheels}) {
    ControllerState memory = begin(car_, full_braking, scene);
    vehicle::VehicleState state = rolling_state(car_, scene.ego, 0.9);
    for (int k = 0; k < 1'000; ++k) {
      vehicle::VehicleState measured = state;
      if (k == 300 && num_failed > 0) {
        for (std::size_t i = 0; i < num_failed; ++i) {
          measured.wheel_speed[i] = measured.brake_torque[i] = nan;
        }
        measured.motor_torque = nan;
      }
      const vehicle::Command command = control(car_, scene.road, 0.9, measured, memory, dt);
      EXPECT_GT(command.brake_torque[vehicle::front_left], 0.0) << k;
      state = vehicle::step(car_, state, command, 0.9, dt);
    }
    unharmed = unharmed.value_or(state.v_B.x);
    EXPECT_NEAR(state.v_B.x, *unharmed, 0.05);
  }
}

TEST_F(Controller, RefusesToBeginWhatCannotBeDriven) {
  EXPECT_THROW((void)begin(car_, {PolicyId::t_drift_left, {}}, test::ego_alone(9.0, 0.9)),
               ContractViolation);
}

}  // namespace
}  // namespace saca::manoeuvre::controller_test
