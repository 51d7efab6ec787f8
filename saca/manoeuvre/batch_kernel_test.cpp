#include "saca/manoeuvre/batch_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/manoeuvre/batch_start.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/vehicle/tyre.h"

// The kernels' own formulas for `double`, against those of the scalar model.
namespace saca::manoeuvre::lanes::batch_kernel_test {
namespace {

using vehicle::VehicleState;
using Flow = vehicle::equations::Flow<double>;

VehicleState random_state(std::mt19937_64& rng, const Car& car) {
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
  };
  VehicleState state;
  state.v_B = {within(0.0, 25.0), within(-4.0, 4.0)};
  state.yaw_rate = within(-2.0, 2.0);
  state.steering = within(-0.5, 0.5);
  state.transfer_a_B = {within(-9.0, 3.0), within(-8.0, 8.0)};
  for (double& speed : state.wheel_speed) {
    speed = within(0.0, 1.1) * state.v_B.x / car.wheel_radius;
  }
  return state;
}

Flow flow_of(const VehicleState& state) {
  Flow flow;
  flow[Flow::vx] = state.v_B.x;
  flow[Flow::vy] = state.v_B.y;
  flow[Flow::yaw_rate] = state.yaw_rate;
  flow[Flow::steering] = state.steering;
  flow[Flow::ax] = state.transfer_a_B.x;
  flow[Flow::ay] = state.transfer_a_B.y;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    flow[Flow::wheel + i] = state.wheel_speed[i];
  }
  return flow;
}

Contacts<double> contacts_in(const Car& car, const Flow& flow, double grip) {
  return contacts_of<double>(car_lane<double>(car, grip), flow,
                             vehicle::equations::turn_by<double>(flow[Flow::steering]), grip);
}

TEST(BatchKernel, ContactsAreThoseOfTheScalarModel) {
  std::mt19937_64 rng(7);
  for (const char* name : shipped_cars) {
    const Car car = shipped_car(name);
    for (int i = 0; i < 200; ++i) {
      const VehicleState state = random_state(rng, car);
      const double grip = std::uniform_real_distribution<double>(0.2, 1.2)(rng);
      const Contacts<double> ours = contacts_in(car, flow_of(state), grip);
      const vehicle::Contacts theirs = vehicle::contacts(car, state, grip);
      for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
        // The same formula, differently summed: rounding of forces of some kN.
        EXPECT_NEAR(ours.F_x[wheel], theirs[wheel].F_T.x, 1e-7);
        EXPECT_NEAR(ours.F_y[wheel], theirs[wheel].F_T.y, 1e-7);
      }
    }
  }
}

TEST(BatchKernel, SlopeIsTheDerivativeOfTheForceAlongTheWheel) {
  std::mt19937_64 rng(8);
  const Car car = default_car();
  constexpr double more = 1e-5;  // [rad/s]
  for (int i = 0; i < 200; ++i) {
    const Flow flow = flow_of(random_state(rng, car));
    const Contacts<double> contacts = contacts_in(car, flow, 0.8);
    for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
      Flow faster = flow;
      Flow slower = flow;
      faster[Flow::wheel + wheel] += more;
      slower[Flow::wheel + wheel] -= more;
      // A faster wheel slides less forward, by its radius.
      const double derivative =
          (contacts_in(car, faster, 0.8).F_x[wheel] - contacts_in(car, slower, 0.8).F_x[wheel]) /
          (2.0 * more * car.wheel_radius);
      const double drag =
          std::abs(contacts.F_x[wheel] /
                   (contacts.v_x[wheel] - car.wheel_radius * flow[Flow::wheel + wheel]));
      // The cosine's polynomial is good to 5e-5, times the shape, below 2; the rest is the
      // quotient's.
      EXPECT_NEAR(contacts.slope[wheel], derivative, 2e-4 * drag + 0.05);
    }
  }
}

TEST(BatchKernel, BodyRatesAreThoseOfTheScalarModel) {
  std::mt19937_64 rng(9);
  const Car car = default_car();
  for (int i = 0; i < 100; ++i) {
    const Flow flow = flow_of(random_state(rng, car));
    const Turn<double> heading = vehicle::equations::turn_by<double>(0.1 * i);
    const Turn<double> middle = vehicle::equations::turn_by<double>(flow[Flow::steering]);
    Flow ours;
    Flow theirs;
    (void)body_rates<double>(car_lane<double>(car, 0.8), flow, contacts_in(car, flow, 0.8), heading,
                             ours);
    const vehicle::equations::Wheels<double> wheels = vehicle::equations::wheels_of<double>(
        static_cast<const vehicle::Vehicle&>(car), flow, middle, {0.8, 0.8, 0.8, 0.8});
    (void)vehicle::equations::body_rates<double>(static_cast<const vehicle::Vehicle&>(car), flow,
                                                 wheels, heading, theirs);
    for (const std::size_t at : {Flow::x, Flow::y, Flow::yaw, Flow::vx, Flow::vy, Flow::yaw_rate}) {
      EXPECT_NEAR(ours[at], theirs[at], 1e-10);
    }
  }
}

TEST(BatchKernel, FrontLoadIsThatOfTheScalarModel) {
  for (const char* name : shipped_cars) {
    const Car car = shipped_car(name);
    for (const double ax : {-30.0, -9.0, 0.0, 4.0, 30.0}) {  // the outer ones lift an axle
      EXPECT_NEAR(front_load(car_lane<double>(car, 0.9), ax), equations::front_load(car, ax), 1e-8);
    }
  }
}

}  // namespace
}  // namespace saca::manoeuvre::lanes::batch_kernel_test
