#include "saca/thinking/rollout/batch_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/vehicle/tyre.h"
#include "saca/thinking/rollout/batch_start.h"

// The kernels' own formulas for `double`, against those of the scalar model.
namespace saca::rollout::lanes::batch_kernel_test {
namespace {

using vehicle::VehicleState;
using StateVector = vehicle::equations::StateVector<double>;

VehicleState random_state(std::mt19937_64& rng, const manoeuvre::Car& car) {
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

StateVector state_vector_of(const VehicleState& state) {
  StateVector state_vector;
  state_vector[StateVector::vx] = state.v_B.x;
  state_vector[StateVector::vy] = state.v_B.y;
  state_vector[StateVector::yaw_rate] = state.yaw_rate;
  state_vector[StateVector::steering] = state.steering;
  state_vector[StateVector::ax] = state.transfer_a_B.x;
  state_vector[StateVector::ay] = state.transfer_a_B.y;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    state_vector[StateVector::wheel + i] = state.wheel_speed[i];
  }
  return state_vector;
}

WheelContacts<double> contacts_in(const manoeuvre::Car& car, const StateVector& state_vector,
                                  double grip) {
  return contacts_of<double>(
      car_lane<double>(car, grip), state_vector,
      vehicle::equations::turn_by<double>(state_vector[StateVector::steering]), grip);
}

TEST(BatchKernel, ContactsAreThoseOfTheScalarModel) {
  std::mt19937_64 rng(7);
  for (const char* name : prepare::shipped_cars) {
    const manoeuvre::Car car = prepare::shipped_car(name);
    for (int i = 0; i < 200; ++i) {
      const VehicleState state = random_state(rng, car);
      const double grip = std::uniform_real_distribution<double>(0.2, 1.2)(rng);
      const WheelContacts<double> ours = contacts_in(car, state_vector_of(state), grip);
      const vehicle::WheelContacts theirs = vehicle::contacts(car, state, grip);
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
  const manoeuvre::Car car = prepare::default_car();
  constexpr double more = 1e-5;  // [rad/s]
  for (int i = 0; i < 200; ++i) {
    const StateVector state_vector = state_vector_of(random_state(rng, car));
    const WheelContacts<double> contacts = contacts_in(car, state_vector, 0.8);
    for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
      StateVector faster = state_vector;
      StateVector slower = state_vector;
      faster[StateVector::wheel + wheel] += more;
      slower[StateVector::wheel + wheel] -= more;
      // A faster wheel slides less forward, by its radius.
      const double derivative =
          (contacts_in(car, faster, 0.8).F_x[wheel] - contacts_in(car, slower, 0.8).F_x[wheel]) /
          (2.0 * more * car.wheel_radius);
      const double drag = std::abs(
          contacts.F_x[wheel] /
          (contacts.v_x[wheel] - car.wheel_radius * state_vector[StateVector::wheel + wheel]));
      // The cosine's polynomial is good to 5e-5, times the shape, below 2; the rest is the
      // quotient's.
      EXPECT_NEAR(contacts.slope[wheel], derivative, 2e-4 * drag + 0.05);
    }
  }
}

TEST(BatchKernel, BodyRatesAreThoseOfTheScalarModel) {
  std::mt19937_64 rng(9);
  const manoeuvre::Car car = prepare::default_car();
  for (int i = 0; i < 100; ++i) {
    const StateVector state_vector = state_vector_of(random_state(rng, car));
    const Turn<double> heading = vehicle::equations::turn_by<double>(0.1 * i);
    const Turn<double> middle =
        vehicle::equations::turn_by<double>(state_vector[StateVector::steering]);
    StateVector ours;
    StateVector theirs;
    (void)body_rates<double>(car_lane<double>(car, 0.8), state_vector,
                             contacts_in(car, state_vector, 0.8), heading, ours);
    const vehicle::equations::Wheels<double> wheels = vehicle::equations::wheels_of<double>(
        static_cast<const vehicle::Vehicle&>(car), state_vector, middle, {0.8, 0.8, 0.8, 0.8});
    (void)vehicle::equations::body_rates<double>(static_cast<const vehicle::Vehicle&>(car),
                                                 state_vector, wheels, heading, theirs);
    for (const std::size_t at : {StateVector::x, StateVector::y, StateVector::yaw, StateVector::vx,
                                 StateVector::vy, StateVector::yaw_rate}) {
      EXPECT_NEAR(ours[at], theirs[at], 1e-10);
    }
  }
}

TEST(BatchKernel, FrontLoadIsThatOfTheScalarModel) {
  for (const char* name : prepare::shipped_cars) {
    const manoeuvre::Car car = prepare::shipped_car(name);
    for (const double ax : {-30.0, -9.0, 0.0, 4.0, 30.0}) {  // the outer ones lift an axle
      EXPECT_NEAR(front_load(car_lane<double>(car, 0.9), ax),
                  manoeuvre::equations::front_load(car, ax), 1e-8);
    }
  }
}

}  // namespace
}  // namespace saca::rollout::lanes::batch_kernel_test
