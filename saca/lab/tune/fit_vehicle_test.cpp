#include "saca/lab/tune/fit_vehicle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/fit_drive.h"

namespace saca::tune::fit_vehicle_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

enum Index : std::size_t {
  grip,
  stiffness,
  shape,
  yaw_inertia,
  drag_area,
  steering_lag,
  dead_time,
  brake_lag
};

constexpr double true_grip = 0.8;

// Somebody's own car: of the default's kind, and different in all that can be fitted.
vehicle::Vehicle own_car() {
  vehicle::Vehicle car = prepare::default_vehicle();
  car.tyre.stiffness = 21.0;
  car.tyre.shape = 1.5;
  car.yaw_inertia = 2400.0;
  car.drag_area = 0.75;
  car.steering_lag = 0.08;
  car.brake_dead_time = 0.03;
  car.brake_lag = 0.09;
  return car;
}

std::array<double, 8> truth() {
  const vehicle::Vehicle car = own_car();
  return {true_grip,     car.tyre.stiffness, car.tyre.shape,      car.yaw_inertia,
          car.drag_area, car.steering_lag,   car.brake_dead_time, car.brake_lag};
}

Log braked(std::uint64_t seed, const vehicle::Vehicle& car = own_car()) {
  return drive_test(car, {.speed = 10.0, .grip = true_grip, .lead_in = 0.3, .seed = 2 * seed});
}

Log steered(std::uint64_t seed, double steering = 0.03, const vehicle::Vehicle& car = own_car()) {
  return drive_test(car, {.kind = TestKind::steer,
                          .grip = true_grip,
                          .steering = steering,
                          .lead_in = 0.3,
                          .turning = 1.0,
                          .seed = 2 * seed + 1});
}

bool holds(const FittedParameter& one, double value) {
  return one.low <= value && value <= one.high;
}

// Half the interval over the value.
double uncertainty(const FittedParameter& one) {
  return 0.5 * (one.high - one.low) / one.value;
}

TEST(VehicleFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int num_seeds = 10;
  const std::array<double, 8> wanted = truth();
  // What such short tests with usual sensors can tell.
  const std::array<double, 8> most_uncertain{0.02, 0.06, 0.1, 0.15, 1.0, 0.15, 0.15, 0.08};
  std::array<int, 8> num_determined{};
  std::array<int, 8> num_held{};
  int all_determined = 0;
  int all_held = 0;
  for (int seed = 1; seed <= num_seeds; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    const VehicleFit fit =
        fit_vehicle(prepare::default_vehicle(), 0.9, {braked(number), steered(number)});
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const FittedParameter& one = fit.parameters[k];
      if (one.determined) {
        ++num_determined[k];
        num_held[k] += holds(one, wanted[k]) ? 1 : 0;
        EXPECT_LT(uncertainty(one), most_uncertain[k]) << one.section << "." << one.key;
      }
    }
  }
  for (const std::size_t k :
       {grip, stiffness, shape, yaw_inertia, steering_lag, dead_time, brake_lag}) {
    // 95 % of 10 are 9.5; fewer than 8 are chance once in 80.
    EXPECT_EQ(num_determined[k], num_seeds) << k;
    EXPECT_GE(num_held[k], 8) << k;
    all_determined += num_determined[k];
    all_held += num_held[k];
  }
  // Those of one fit are not independent: an sd of some 3.5 %. 40 seeds gave 90 to 98 % for each.
  EXPECT_GE(all_held, 0.85 * all_determined);
}

TEST(VehicleFit, WithoutNoiseFindsTheCarItself) {
  const std::array<double, 8> wanted = truth();
  const VehicleFit fit = fit_vehicle(
      prepare::default_vehicle(), 0.9,
      {drive_test(own_car(), {.speed = 14.0, .grip = true_grip, .noise = 0.0}),
       drive_test(own_car(), {.kind = TestKind::steer, .grip = true_grip, .noise = 0.0})});
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    // What is known beforehand pulls a little, and more on what is known less: 1 %.
    EXPECT_TRUE(fit.parameters[k].determined) << fit.parameters[k].key;
    EXPECT_NEAR(fit.parameters[k].value, wanted[k], 0.01 * wanted[k]) << fit.parameters[k].key;
  }
  EXPECT_EQ(fit.car.brake_dead_time, 0.03);
}

TEST(VehicleFit, KeepsTheBaseWhereTheLogsSayNothing) {
  const vehicle::Vehicle base = prepare::default_vehicle();
  const VehicleFit fit = fit_vehicle(base, 0.9, {steered(1)});
  for (const std::size_t k : {shape, dead_time, brake_lag}) {
    EXPECT_FALSE(fit.parameters[k].determined);
    EXPECT_EQ(fit.parameters[k].value, fit.parameters[k].base);
  }
  EXPECT_EQ(fit.car.brake_lag, base.brake_lag);
  EXPECT_EQ(fit.car.tyre.shape, base.tyre.shape);
  EXPECT_EQ(fit.car.mass, base.mass);
  EXPECT_TRUE(fit.parameters[stiffness].determined);
  const VehicleFit brakes = fit_vehicle(base, 0.9, {braked(1)});
  EXPECT_FALSE(brakes.parameters[yaw_inertia].determined);
  EXPECT_FALSE(brakes.parameters[steering_lag].determined);
  EXPECT_TRUE(brakes.parameters[brake_lag].determined);
}

// White noise does not know left from right: a mirrored log is the same test.
TEST(VehicleFit, OfAStepToTheRightIsThatOfTheStepToTheLeft) {
  Log right = steered(4);
  for (vehicle::Command& command : right.command) {
    command.steering = -command.steering;
  }
  for (Series& series : right.measured) {
    if (series.signal != Signal::speed) {
      for (double& value : series.values) {
        value = -value;
      }
    }
  }
  const VehicleFit one = fit_vehicle(prepare::default_vehicle(), 0.9, {steered(4)});
  const VehicleFit other = fit_vehicle(prepare::default_vehicle(), 0.9, {right});
  for (std::size_t k = 0; k < one.parameters.size(); ++k) {
    EXPECT_EQ(one.parameters[k].determined, other.parameters[k].determined);
    EXPECT_NEAR(one.parameters[k].value, other.parameters[k].value, 1e-4 * one.parameters[k].value);
  }
}

TEST(VehicleFit, ReportsOutliersAndIsNotMovedByThem) {
  Log log = steered(6);
  Series& yaw_rate = log.measured[2];
  ASSERT_EQ(yaw_rate.signal, Signal::yaw_rate);
  for (const std::size_t row : {40U, 77U, 110U}) {
    yaw_rate.values[row] += from_degrees(20.0);
  }
  const VehicleFit fit = fit_vehicle(prepare::default_vehicle(), true_grip, {log});
  EXPECT_THAT(fit.warnings, Contains(AllOf(HasSubstr("yaw_rate_degps: 3 of"), HasSubstr("0.4 s"))));
  EXPECT_TRUE(holds(fit.parameters[stiffness], own_car().tyre.stiffness));
  EXPECT_TRUE(holds(fit.parameters[yaw_inertia], own_car().yaw_inertia));
}

TEST(VehicleFit, FindsASensorsOffsetAndReportsALargeOne) {
  Log log = steered(7);
  for (double& value : log.measured[2].values) {
    value += from_degrees(2.0);
  }
  const VehicleFit fit = fit_vehicle(prepare::default_vehicle(), true_grip, {log});
  ASSERT_EQ(fit.signals[2].signal, Signal::yaw_rate);
  EXPECT_NEAR(fit.signals[2].offset, 2.0, 0.2);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("yaw_rate_degps: the sensor seems to be off")));
  EXPECT_TRUE(holds(fit.parameters[stiffness], own_car().tyre.stiffness));
}

// Braking with known torques tells the mass; a wrong one in the base cannot hide.
TEST(VehicleFit, ReportsWhatTheModelCannotFollow) {
  vehicle::Vehicle loaded = own_car();
  loaded.mass *= 1.25;
  const VehicleFit fit = fit_vehicle(prepare::default_vehicle(), 0.9, {braked(1, loaded)});
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("systematic residual")));
  EXPECT_TRUE(fit_vehicle(prepare::default_vehicle(), 0.9, {steered(1)}).warnings.empty());
}

TEST(VehicleFit, OfAnotherKindOfCarIsFiniteAndWarned) {
  vehicle::Vehicle truck = prepare::default_vehicle();
  truck.mass = 12'000.0;
  truck.yaw_inertia = 60'000.0;
  truck.cg_to_front_axle = 3.0;
  truck.cg_to_rear_axle = 2.0;
  truck.cg_height = 1.2;
  truck.tyre.nominal_load = 29'000.0;
  truck.tyre.stiffness = 8.0;
  truck.wheel_radius = 0.5;
  truck.front_wheel_inertia = 20.0;
  truck.rear_wheel_inertia = 40.0;
  truck.brake_limit = 20'000.0;
  const VehicleFit fit = fit_vehicle(prepare::default_vehicle(), 0.9, {steered(1, 0.02, truck)});
  EXPECT_FALSE(fit.warnings.empty());
  for (const FittedParameter& one : fit.parameters) {
    EXPECT_TRUE(std::isfinite(one.value) && std::isfinite(one.low) && std::isfinite(one.high));
  }
}

}  // namespace
}  // namespace saca::tune::fit_vehicle_test
