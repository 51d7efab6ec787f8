#include "saca/onboard/vehicle/vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::vehicle::vehicle_test {
namespace {

constexpr double dt = 1e-3;

class Dynamics : public testing::Test {
 protected:
  [[nodiscard]] VehicleState after(VehicleState state, double seconds, const Command& command,
                                   double grip = 0.9, double step_size = dt) const {
    const auto num_steps = std::lround(seconds / step_size);
    for (int i = 0; i < num_steps; ++i) {
      state = step(car_, state, command, grip, step_size);
    }
    return state;
  }

  // Mass with the wheels' spin: m + sum of I / R^2.
  [[nodiscard]] double effective_mass() const {
    return car_.mass + 2.0 * (car_.front_wheel_inertia + car_.rear_wheel_inertia) /
                           (car_.wheel_radius * car_.wheel_radius);
  }

  const Vehicle car_ = prepare::default_vehicle();
};

Command braking(double torque) {
  Command command;
  command.brake_torque.fill(torque);
  return command;
}

// A drive that uses everything: steering to and fro, motor and brakes.
Command lively(int i) {
  Command command;
  command.steering = 0.12 * std::sin(4e-3 * i);
  command.motor_torque = i < 300 ? 1500.0 : 0.0;
  if (i > 600) {
    command.brake_torque = {700.0, 500.0, 300.0, 250.0};
  }
  return command;
}

TEST_F(Dynamics, LoadsAddUpToTheWeightAndMoveByHand) {
  const PerWheel still = wheel_loads(car_, {});
  // 1700 kg x 9.80665 x 1.45 / 2.8 / 2 in front of each other side.
  EXPECT_NEAR(still[front_left], 4316.68, 0.01);
  EXPECT_NEAR(still[rear_right], 4018.97, 0.01);
  const PerWheel moved = wheel_loads(car_, {-5.0, 3.0});
  // Pitch 1700 x 5 x 0.5 / 2.8 = 1517.86 N to the front axle; roll 1700 x 3 x 0.5 / 1.6 = 1593.75 N
  // to the right wheels, half of it in front.
  EXPECT_NEAR(moved[front_left] - still[front_left], 758.93 - 796.875, 0.01);
  EXPECT_NEAR(moved[rear_right] - still[rear_right], -758.93 + 796.875, 0.01);
  EXPECT_NEAR(moved[0] + moved[1] + moved[2] + moved[3], car_.mass * gravity, 1e-9);
}

TEST_F(Dynamics, CoastingSlowsByAirDrag) {
  const VehicleState end = after(prepare::rolling(car_, 20.0), 1.0, {});
  const double deceleration = 0.5 * 1.225 * car_.drag_area * 20.0 * 20.0 / effective_mass();
  EXPECT_NEAR(20.0 - end.v_B.x, deceleration, 0.02 * deceleration);  // drag falls 1 % on the way
  EXPECT_NEAR(end.X_WB.p.y, 0.0, 1e-12);
}

TEST_F(Dynamics, TheMotorAcceleratesCarAndWheels) {
  Command command;
  command.motor_torque = 800.0;
  const VehicleState end = after(prepare::rolling(car_, 5.0), 0.5, command);
  // Full torque after its 20 ms lag: 0.48 s of it.
  EXPECT_NEAR(end.v_B.x - 5.0, 800.0 / car_.wheel_radius / effective_mass() * 0.48, 0.01);
}

TEST_F(Dynamics, BrakesWaitForTheirDeadTimeThenBuildUp) {
  VehicleState state = prepare::rolling(car_, 20.0);
  const Command command = braking(100.0);
  state = after(state, 0.040, command);
  EXPECT_EQ(state.brake_torque[front_left], 0.0);
  state = after(state, 0.060, command);  // one time constant
  EXPECT_NEAR(state.brake_torque[rear_left], 100.0 * (1.0 - std::exp(-1.0)), 1e-6);
}

TEST_F(Dynamics, TheSameDeadTimeHoldsForAnyStep) {
  for (const double step_size : {0.25e-3, 0.5e-3, 1e-3}) {
    const VehicleState state =
        after(prepare::rolling(car_, 20.0), 0.1, braking(100.0), 0.9, step_size);
    EXPECT_NEAR(state.brake_torque[0], 100.0 * (1.0 - std::exp(-1.0)), 1e-6) << step_size;
  }
}

TEST_F(Dynamics, SteeringIsLimitedInRateAndAngle) {
  Command command;
  command.steering = 1.0;
  VehicleState state = after(prepare::rolling(car_, 1.0), 0.2, command);
  EXPECT_NEAR(to_degrees(state.steering), 60.0 * 0.2, 0.01);
  state = after(state, 1.5, command);
  EXPECT_NEAR(to_degrees(state.steering), 35.0, 1e-3);
}

// Equal stiffness per load in front and behind: neutral, so yaw rate = speed x tan(angle) /
// wheelbase.
TEST_F(Dynamics, TurnsNeutrallyWhenSlow) {
  Command command;
  command.steering = 0.03;
  command.motor_torque = 60.0;  // about what keeps the speed
  const VehicleState state = after(prepare::rolling(car_, 8.0), 4.0, command);
  const double wheelbase = car_.cg_to_front_axle + car_.cg_to_rear_axle;
  EXPECT_NEAR(state.yaw_rate, state.v_B.x * std::tan(0.03) / wheelbase, 0.02 * state.yaw_rate);
  EXPECT_NEAR(state.a_B.y, state.v_B.x * state.yaw_rate, 1e-3);
}

TEST_F(Dynamics, LockedWheelsSlideToRest) {
  // Slip 1: the share of the peak is that of the curve's tail.
  const double share = force_share(car_.tyre, 0.9, 1.0);
  VehicleState state = after(prepare::rolling(car_, 20.0), 0.8, braking(3000.0));
  for (const double speed : state.wheel_speed) {
    EXPECT_EQ(speed, 0.0);
  }
  const double drag = 0.5 * 1.225 * car_.drag_area * state.v_B.x * state.v_B.x / car_.mass;
  EXPECT_NEAR(-state.a_B.x, share * 0.9 * gravity + drag, 0.2);  // less load sensitivity, 2 %
  state = after(state, 3.0, braking(3000.0));
  EXPECT_TRUE(at_rest(state));
}

TEST_F(Dynamics, RestStaysRest) {
  const VehicleState start;
  for (const double brakes : {0.0, 1000.0}) {
    const VehicleState end = after(start, 1.0, braking(brakes));
    EXPECT_EQ(end.X_WB.p.x, 0.0);
    EXPECT_EQ(end.X_WB.yaw, 0.0);
    EXPECT_TRUE(at_rest(end));
  }
}

TEST_F(Dynamics, BrakesHoldAgainstAWeakerMotorAndLetGo) {
  VehicleState state = after({}, 0.3, braking(500.0));
  Command command = braking(500.0);
  command.motor_torque = 1500.0;
  state = after(state, 1.0, command);
  EXPECT_EQ(state.X_WB.p.x, 0.0);
  command.brake_torque = {};
  state = after(state, 1.0, command);
  EXPECT_GT(state.v_B.x, 1.0);
}

TEST_F(Dynamics, StopsWithoutChatter) {
  VehicleState state = prepare::rolling(car_, 3.0);
  double slowest = 3.0;
  for (int i = 0; i < 3000; ++i) {
    state = step(car_, state, braking(800.0), 0.9, dt);
    ASSERT_LE(state.v_B.x, slowest + 1e-9) << i;
    ASSERT_GE(state.v_B.x, 0.0) << i;
    slowest = state.v_B.x;
  }
  EXPECT_TRUE(at_rest(state));
}

TEST_F(Dynamics, EnergyIsNeverCreatedWithoutTheMotor) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> torque(0.0, 2500.0);
  std::uniform_real_distribution<double> angle(-0.5, 0.5);
  std::uniform_real_distribution<double> speed(0.5, 25.0);
  for (int run = 0; run < 12; ++run) {
    VehicleState state = prepare::rolling(car_, speed(rng));
    state.yaw_rate = 0.5 * angle(rng);
    Command command;
    for (int i = 0; i < 600; ++i) {
      if (i % 100 == 0) {
        command.steering = angle(rng);
        command.brake_torque = {torque(rng), torque(rng), torque(rng), torque(rng)};
      }
      const double before = kinetic_energy(car_, state);
      state = step(car_, state, command, 0.7, dt);
      ASSERT_LE(kinetic_energy(car_, state), before * (1.0 + 1e-9) + 1e-9) << run << " " << i;
    }
  }
}

TEST_F(Dynamics, NoWheelEverLeavesItsFrictionCircle) {
  VehicleState state = prepare::rolling(car_, 22.0);
  for (int i = 0; i < 1500; ++i) {
    state = step(car_, state, lively(3 * i), 0.5, dt);
    for (const WheelContact& wheel : contacts(car_, state, 0.5)) {
      ASSERT_LE(norm(wheel.F_T), wheel.peak_force * (1.0 + 1e-12));
      ASSERT_GE(wheel.load, 0.0);
    }
  }
}

TEST_F(Dynamics, LeftIsTheMirrorOfRight) {
  VehicleState left = prepare::rolling(car_, 15.0);
  VehicleState right = left;
  for (int i = 0; i < 1200; ++i) {
    const Command command = lively(i);
    Command mirrored = command;
    mirrored.steering = -command.steering;
    std::swap(mirrored.brake_torque[front_left], mirrored.brake_torque[front_right]);
    std::swap(mirrored.brake_torque[rear_left], mirrored.brake_torque[rear_right]);
    left = step(car_, left, command, 0.8, dt);
    right = step(car_, right, mirrored, 0.8, dt);
  }
  EXPECT_NEAR(left.X_WB.p.x, right.X_WB.p.x, 1e-9);
  EXPECT_NEAR(left.X_WB.p.y, -right.X_WB.p.y, 1e-9);
  EXPECT_NEAR(left.X_WB.yaw, -right.X_WB.yaw, 1e-9);
  EXPECT_NEAR(left.wheel_speed[front_left], right.wheel_speed[front_right], 1e-9);
  EXPECT_GT(std::abs(left.X_WB.p.y), 0.1);
}

TEST_F(Dynamics, TheWorldMayBeTurned) {
  const Pose X_VW{{30.0, -7.0}, std::numbers::pi / 2.0};
  VehicleState state = prepare::rolling(car_, 15.0);
  VehicleState turned = state;
  turned.X_WB = X_VW * state.X_WB;
  for (int i = 0; i < 1200; ++i) {
    state = step(car_, state, lively(i), 0.8, dt);
    turned = step(car_, turned, lively(i), 0.8, dt);
  }
  const Pose expected = X_VW * state.X_WB;
  EXPECT_NEAR(turned.X_WB.p.x, expected.p.x, 1e-9);
  EXPECT_NEAR(turned.X_WB.p.y, expected.p.y, 1e-9);
  EXPECT_NEAR(turned.X_WB.yaw, expected.yaw, 1e-9);
}

TEST_F(Dynamics, SameInputSameBytes) {
  VehicleState a = prepare::rolling(car_, 15.0);
  VehicleState b = a;
  for (int i = 0; i < 900; ++i) {
    a = step(car_, a, lively(i), 0.8, dt);
    b = step(car_, b, lively(i), 0.8, dt);
  }
  EXPECT_EQ(a.X_WB.p.x, b.X_WB.p.x);
  EXPECT_EQ(a.X_WB.p.y, b.X_WB.p.y);
  EXPECT_EQ(a.X_WB.yaw, b.X_WB.yaw);
  EXPECT_EQ(a.v_B.y, b.v_B.y);
  EXPECT_EQ(a.wheel_speed, b.wheel_speed);
  EXPECT_EQ(a.brake_torque, b.brake_torque);
}

// A smooth drive: constant commands, the steering below its rate limit. Classical Runge-Kutta: half
// the step, a sixteenth of the error.
TEST_F(Dynamics, ConvergesWithFourthOrder) {
  Command command;
  command.steering = 0.045;
  command.motor_torque = 900.0;
  const auto end_y = [&](double step_size) {
    return after(prepare::rolling(car_, 15.0), 0.8, command, 0.9, step_size).X_WB.p.y;
  };
  const double exact = end_y(0.0625e-3);
  const double coarse = std::abs(end_y(1e-3) - exact);
  const double fine = std::abs(end_y(0.5e-3) - exact);
  EXPECT_LT(coarse, 1e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.4);
}

TEST_F(Dynamics, TheLongestStepFollowsFromAWheelThatRollsSlowly) {
  // R^2 stiffness load / (inertia floor) in front, with 15 % more than the load at rest:
  // 0.32^2 x 18 x 1.15 x 4317 N / (1.2 x 4) = 1906 1/s; beyond 2.785 of them Runge-Kutta grows.
  EXPECT_NEAR(longest_step(car_), 2.78 / 1906.3, 2e-6);
  Vehicle light = car_;
  light.front_wheel_inertia = 0.6;
  EXPECT_NEAR(longest_step(light), 0.5 * longest_step(car_), 1e-9);
}

// Any speed, any steering: no wheel swings about the speed at which it rolls.
TEST_F(Dynamics, TheLongestStepIsStable) {
  for (const double speed : {0.5, 2.0, 4.0, 10.0}) {
    VehicleState state = prepare::rolling(car_, speed);
    state.wheel_speed[front_left] += 1.0;
    Command command;
    command.steering = 0.5;
    for (int i = 0; i < 1000; ++i) {
      state = step(car_, state, command, 0.9, longest_step(car_));
    }
    VehicleState next = state;
    for (int i = 0; i < 20; ++i) {
      next = step(car_, next, command, 0.9, longest_step(car_));
      for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
        ASSERT_NEAR(next.wheel_speed[wheel], state.wheel_speed[wheel], 0.02 * (i + 1)) << speed;
      }
    }
  }
}

// Braked wheels on ice at the left, on tarmac at the right: the difference of forces turns the car
// to the right at first, with half the track as its arm.
TEST_F(Dynamics, SplitGripTurnsTheCarTowardsTheBetterSide) {
  const PerWheel grip{0.2, 0.9, 0.2, 0.9};
  VehicleState state = prepare::rolling(car_, 20.0);
  Command command;
  command.brake_torque = {200.0, 900.0, 150.0, 500.0};
  for (int i = 0; i < 100; ++i) {
    state = step(car_, state, command, grip, dt);
  }
  const VehicleState before = state;
  state = step(car_, state, command, grip, dt);
  const WheelContacts wheels = contacts(car_, before, grip);
  double moment = 0.0;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const Vec2 p_B = wheel_position(car_, i);
    moment += p_B.x * wheels[i].F_T.y - p_B.y * wheels[i].F_T.x;
    EXPECT_LE(norm(wheels[i].F_T), wheels[i].peak_force);
  }
  EXPECT_LT(moment,
            -0.4 * car_.track_width * (wheels[front_left].F_T.x - wheels[front_right].F_T.x));
  EXPECT_NEAR((state.yaw_rate - before.yaw_rate) / dt, moment / car_.yaw_inertia,
              0.05 * std::abs(moment) / car_.yaw_inertia);
  EXPECT_LT(state.yaw_rate, 0.0);
}

TEST_F(Dynamics, RefusesWhatIsNotAStep) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const VehicleState state = prepare::rolling(car_, 10.0);
  VehicleState bad = state;
  bad.v_B.y = nan;
  Command bad_command;
  bad_command.steering = nan;
  EXPECT_THROW((void)step(car_, bad, {}, 0.9, dt), ContractViolation);
  EXPECT_THROW((void)step(car_, state, bad_command, 0.9, dt), ContractViolation);
  EXPECT_THROW((void)step(car_, state, {}, nan, dt), ContractViolation);
  EXPECT_THROW((void)step(car_, state, {}, 0.0, dt), ContractViolation);
  EXPECT_THROW((void)step(car_, state, {}, 0.9, 0.0), ContractViolation);
  EXPECT_THROW((void)step(car_, state, {}, 0.9, 1.01 * longest_step(car_)), ContractViolation);
  EXPECT_THROW((void)step(car_, state, {}, PerWheel{0.9, 0.9, nan, 0.9}, dt), ContractViolation);
  EXPECT_THROW((void)after(state, 0.1, braking(-1.0)), ContractViolation);
}

}  // namespace
}  // namespace saca::vehicle::vehicle_test
