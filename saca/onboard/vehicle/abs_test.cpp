#include "saca/onboard/vehicle/abs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/vehicle/prototype.h"

namespace saca::vehicle::abs_test {
namespace {

constexpr double dt = 1e-3;

struct Stop {
  double distance = 0.0;
  double time = 0.0;
  double peak = 0.0;          // deceleration
  double deepest_slip = 0.0;  // above 3 m/s
};

using Brakes = std::function<PerWheel(const VehicleState&)>;

Stop stop(const Vehicle& car, double speed, double grip, const Brakes& brakes) {
  VehicleState state = prepare::rolling(car, speed);
  Stop result;
  for (int i = 1; i < 12'000 && !at_rest(state); ++i) {
    state = step(car, state, {.brake_torque = brakes(state)}, grip, dt);
    result.time = i * dt;
    result.peak = std::max(result.peak, -state.a_B.x);
    if (state.v_B.x > 3.0) {
      for (const WheelContact& wheel : contacts(car, state, grip)) {
        result.deepest_slip = std::max(result.deepest_slip, wheel.slip);
      }
    }
  }
  result.distance = state.X_WB.p.x;
  return result;
}

Stop ideal_stop(const Vehicle& car, double speed, double grip) {
  return stop(car, speed, grip,
              [&](const VehicleState& state) { return ideal_brakes(car, state, grip); });
}

Stop deployed_stop(const Vehicle& car, double speed, double grip, double estimate) {
  AbsState abs = begin_abs(speed);
  return stop(car, speed, grip, [&](const VehicleState& state) {
    return deployed_brakes(car, state, 20.0, estimate, dt, abs);
  });
}

TEST(IdealBrakes, StopWithinFivePercentOfTheReference) {
  const Vehicle car = prepare::default_vehicle();
  for (const auto& [speed, grip, distance, time] : prototype_stops) {
    const Stop result = ideal_stop(car, speed, grip);
    EXPECT_NEAR(result.distance, distance, 0.05 * distance) << speed << " " << grip;
    EXPECT_NEAR(result.time, time, 0.05 * time) << speed << " " << grip;
  }
}

// Nothing stops sooner than friction alone after the dead time: v^2 / (2 mu g), less what air
// takes.
TEST(IdealBrakes, CannotBeatFriction) {
  const Vehicle car = prepare::default_vehicle();
  for (const double speed : {8.0, 14.0, 25.0}) {
    const double air = 0.5 * 1.225 * car.drag_area * speed * speed / car.mass;
    const double least =
        speed * speed / (2.0 * (0.9 * gravity + air)) + speed * car.brake_dead_time;
    EXPECT_GT(ideal_stop(car, speed, 0.9).distance, least);
  }
}

TEST(IdealBrakes, PeakDecelerationIsThatOfTheReference) {
  const Vehicle car = prepare::default_vehicle();
  for (const auto& [grip, deceleration] : prototype_peaks) {
    EXPECT_NEAR(ideal_stop(car, 14.0, grip).peak, deceleration, 0.05 * deceleration) << grip;
  }
}

TEST(DeployedBrakes, StopWithinTheBandOfTheReference) {
  const Vehicle car = prepare::default_vehicle();
  for (const auto& [speed, grip, distance, time] : prototype_stops) {
    const Stop result = deployed_stop(car, speed, grip, grip);
    EXPECT_GT(result.distance, 0.97 * distance) << speed << " " << grip;
    EXPECT_LT(result.distance, 1.12 * distance) << speed << " " << grip;
    EXPECT_GT(result.time, 0.97 * time) << speed << " " << grip;
    EXPECT_LT(result.time, 1.12 * time) << speed << " " << grip;
  }
}

// The estimate is only where it starts from: the wheels tell it the rest.
TEST(DeployedBrakes, ForgiveAWrongGrip) {
  const Vehicle car = prepare::default_vehicle();
  for (const double grip : {0.35, 0.6, 0.9}) {
    const double right = deployed_stop(car, 15.0, grip, grip).distance;
    for (const double factor : {0.8, 0.94, 1.06, 1.2}) {
      const Stop result = deployed_stop(car, 15.0, grip, factor * grip);
      const double longer = factor == 0.8 ? 1.15 : 1.05;  // what it has not dared to try yet
      EXPECT_LT(result.distance, longer * right) << grip << " " << factor;
      EXPECT_LT(result.deepest_slip, 0.35) << grip << " " << factor;
    }
  }
}

TEST(DeployedBrakes, ForgiveAWrongSpeed) {
  const Vehicle car = prepare::default_vehicle();
  const double right = deployed_stop(car, 14.0, 0.9, 0.9).distance;
  for (const double error : {-0.3, 0.3}) {  // twice the sensor's standard deviation
    AbsState abs = begin_abs(14.0 + error);
    const Stop result = stop(car, 14.0, 0.9, [&](const VehicleState& state) {
      return deployed_brakes(car, state, 20.0, 0.9, dt, abs);
    });
    EXPECT_LT(result.distance, 1.1 * right) << error;
  }
}

TEST(DeployedBrakes, GiveThePartThatIsWanted) {
  const Vehicle car = prepare::default_vehicle();
  AbsState abs = begin_abs(20.0);
  VehicleState state = prepare::rolling(car, 20.0);
  for (int i = 0; i < 1000; ++i) {
    state =
        step(car, state, {.brake_torque = deployed_brakes(car, state, 3.0, 0.9, dt, abs)}, 0.9, dt);
  }
  // The wanted deceleration and, on top, air drag of 0.07 m/s^2.
  EXPECT_NEAR(-state.a_B.x, 3.0, 0.3);
}

}  // namespace
}  // namespace saca::vehicle::abs_test
