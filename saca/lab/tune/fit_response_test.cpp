#include "saca/lab/tune/fit_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/fit_drive.h"

namespace saca::tune::fit_response_test {
namespace {

const TestDrive gentle{.speed = 12.0, .deceleration = 5.0, .lead_in = 0.2, .noise = 0.0};

// Speeds at the rows by the plain loop that any simulation has: dead time in the brake line.
std::vector<double> stepped_speeds(const Log& log, const vehicle::Vehicle& car, double grip) {
  vehicle::VehicleState state = prepare::rolling(car, 12.0);
  state.motor_torque = log.command.front().motor_torque;
  std::vector<double> speeds;
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    speeds.push_back(state.v_B.x);
    for (int k = 0; k < 10; ++k) {
      state = vehicle::step(car, state, log.command[row], grip, 1e-3);
    }
  }
  return speeds;
}

std::vector<double> speeds_of(const Log& log, const vehicle::Vehicle& car) {
  const std::vector<double> all =
      response(log, held_speed(log), {.car = car, .grip = 0.9, .speed = 12.0});
  std::vector<double> speeds;
  for (std::size_t i = 0; i < all.size(); i += log.measured.size()) {
    speeds.push_back(all[i]);
  }
  return speeds;
}

TEST(Response, WithADeadTimeOfWholeMillisecondsIsThatOfTheBrakeLine) {
  vehicle::Vehicle car = prepare::default_vehicle();
  const Log log = drive_test(car, gentle);
  for (const double dead_time : {0.0, 0.017, 0.04, 0.06}) {
    car.brake_dead_time = dead_time;
    const std::vector<double> wanted = stepped_speeds(log, car, 0.9);
    const std::vector<double> speeds = speeds_of(log, car);
    ASSERT_EQ(speeds.size(), wanted.size());
    for (std::size_t row = 0; row < wanted.size(); ++row) {
      EXPECT_NEAR(speeds[row], wanted[row], 1e-6) << dead_time << " s, row " << row;
    }
  }
}

TEST(Response, BetweenMillisecondsLiesBetweenItsNeighbours) {
  vehicle::Vehicle car = prepare::default_vehicle();
  const Log log = drive_test(car, gentle);
  const std::size_t row = log.event + 20;  // 0.2 s into the braking
  const auto speed_with = [&](double dead_time) {
    car.brake_dead_time = dead_time;
    return speeds_of(log, car)[row];
  };
  const double earlier = speed_with(0.030);
  const double later = speed_with(0.031);
  ASSERT_GT(later - earlier, 1e-3);  // 1 ms at some 5 m/s^2
  for (const double share : {0.25, 0.5, 0.75}) {
    // Linear in the dead time but for what the response bends within 1 ms: O(0.001^2) of 100 m/s^3.
    EXPECT_NEAR(speed_with(0.030 + 0.001 * share), earlier + share * (later - earlier), 1e-4);
  }
}

TEST(Response, FollowsTheLoggedSpeedWhereTheMotorIsNotKnown) {
  const vehicle::Vehicle car = prepare::default_vehicle();
  const Log log =
      drive_test(car, {.kind = TestKind::steer, .speed = 20.0, .noise = 0.0, .motor_known = false});
  const std::vector<double> speeds =
      response(log, held_speed(log), {.car = car, .grip = 0.9, .speed = 20.0});
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    EXPECT_NEAR(speeds[row * log.measured.size()], log.measured.front().values[row], 0.05);
  }
}

TEST(HeldSpeed, IsAMeanOfTheNeighbours) {
  Log log = drive_test(prepare::default_vehicle(),
                       {.kind = TestKind::steer, .noise = 0.0, .motor_known = false});
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    log.measured.front().values[row] = 20.0 + 2.0 * log.time[row];
  }
  const std::vector<double> held = held_speed(log);
  for (std::size_t row = 30; row + 30 < held.size(); ++row) {
    EXPECT_NEAR(held[row], 20.0 + 2.0 * log.time[row], 1e-9);  // a straight line is its own mean
  }
  log.motor_known = true;
  EXPECT_TRUE(held_speed(log).empty());
}

}  // namespace
}  // namespace saca::tune::fit_response_test
