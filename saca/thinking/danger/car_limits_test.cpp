#include "saca/thinking/danger/car_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::danger::car_limits_test {
namespace {

vehicle::Vehicle rear_driven() {
  vehicle::Vehicle car{};
  car.mass = 1'700.0;
  car.cg_to_front_axle = 1.35;
  car.cg_to_rear_axle = 1.45;
  car.wheel_radius = 0.32;
  car.steering_limit = 35.0 * std::numbers::pi / 180.0;
  car.motor_limit = 3'200.0;
  car.motor_front_share = 0.0;
  return car;
}

// 2.8 m / tan 35 deg = 3.999 m to the middle of the rear axle, 1.45 m behind the centre of mass.
TEST(AvoidanceOf, TurnsAboutACentreBesideTheRearAxle) {
  EXPECT_NEAR(avoidance_of(rear_driven(), 0.9).tightest_curvature, 1.0 / std::hypot(3.999, 1.45),
              1e-4);
}

TEST(AvoidanceOf, DrivesWithWhatStandsOnTheDrivenWheels) {
  vehicle::Vehicle car = rear_driven();
  EXPECT_NEAR(avoidance_of(car, 0.9).drive_share, 1.35 / 2.8, 1e-12);
  car.motor_front_share = 1.0;
  EXPECT_NEAR(avoidance_of(car, 0.9).drive_share, 1.45 / 2.8, 1e-12);
  car.motor_front_share = 1.45 / 2.8;  // each axle its own share: all of the grip
  car.motor_limit = 1e5;
  EXPECT_NEAR(avoidance_of(car, 0.9).drive_share, 1.0, 1e-12);
}

// 1000 N m at 0.32 m push 1700 kg with 1.838 m/s^2: 0.208 of 0.9 g.
TEST(AvoidanceOf, DrivesNoHarderThanTheMotor) {
  vehicle::Vehicle car = rear_driven();
  car.motor_limit = 1'000.0;
  EXPECT_NEAR(avoidance_of(car, 0.9).drive_share, 1'000.0 / 0.32 / 1'700.0 / (0.9 * 9.80665),
              1e-12);
  car.motor_limit = 0.0;
  EXPECT_EQ(avoidance_of(car, 0.9).drive_share, 0.0);
  EXPECT_THROW((void)avoidance_of(car, 0.0), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::car_limits_test
