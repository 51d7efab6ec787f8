#include "saca/onboard/manoeuvre/demand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::demand_test {
namespace {

constexpr double dt = 1e-3;

/// What the car has come to after so long under a demand.
vehicle::VehicleState after(const Car& car, const Demand& demand, double speed, double grip,
                            double seconds) {
  vehicle::VehicleState state = rolling_state(car, test::ego_alone(speed, grip).ego, grip);
  vehicle::AbsState abs = vehicle::begin_abs(speed);
  for (int i = 0; i < std::lround(seconds / dt); ++i) {
    state = vehicle::step(car, state, command_for(car, demand, grip, state, abs, dt), grip, dt);
  }
  return state;
}

TEST(Demand, IsMovedOntoTheDisc) {
  const Demand inside = admissible({-0.3, 0.4});
  EXPECT_EQ(inside.along, -0.3);
  EXPECT_EQ(inside.across, 0.4);
  const Demand beyond = admissible({3.0, -4.0});
  EXPECT_DOUBLE_EQ(beyond.along, 0.6);
  EXPECT_DOUBLE_EQ(beyond.across, -0.8);
}

// Half of what the grip gives is well within what tyres and controllers do: once the actuators have
// followed, the car accelerates as it is asked to, whichever car on whichever grip.
TEST(Demand, IsMetWhereTheTyresCan) {
  for (const char* name : prepare::shipped_cars) {
    const Car car = prepare::shipped_car(name);
    for (const double grip : {0.4, 0.9}) {
      const double g = grip * vehicle::gravity;
      const std::string told = std::string(name) + " on " + std::to_string(grip);
      EXPECT_NEAR(after(car, {-0.5, 0.0}, 20.0, grip, 0.8).a_B.x, -0.5 * g, 0.1 * g) << told;
      EXPECT_NEAR(after(car, {0.0, 0.5}, 15.0, grip, 1.2).a_B.y, 0.5 * g, 0.1 * g) << told;
      EXPECT_GT(after(car, {0.2, 0.0}, 10.0, grip, 0.8).a_B.x, 0.1 * g) << told;
    }
  }
}

TEST(Demand, IsMirrored) {
  const Car car = prepare::default_car();
  const auto left = after(car, {-0.4, 0.6}, 18.0, 0.8, 1.0);
  const auto right = after(car, {-0.4, -0.6}, 18.0, 0.8, 1.0);
  EXPECT_NEAR(left.X_WB.p.y, -right.X_WB.p.y, 1e-9);
  EXPECT_NEAR(left.yaw_rate, -right.yaw_rate, 1e-9);
  EXPECT_NEAR(left.v_B.x, right.v_B.x, 1e-9);
}

// All round the disc, from slow to fast: whatever is asked for, the car does not spin. At 5 m/s the
// tightest turn alone takes some 20 degrees of sideslip.
TEST(Demand, DoesNotSpinTheCar) {
  for (const char* name : prepare::shipped_cars) {
    const Car car = prepare::shipped_car(name);
    for (const double speed : {5.0, 15.0, 30.0}) {
      for (int k = 0; k < 12; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 12.0;
        const auto state = after(car, {std::cos(angle), std::sin(angle)}, speed, 0.9, 1.5);
        ASSERT_TRUE(std::isfinite(state.v_B.x));
        if (norm(state.v_B) > 3.0) {
          EXPECT_LT(std::abs(std::atan2(state.v_B.y, state.v_B.x)), from_degrees(25.0))
              << name << " at " << speed << " m/s, input " << k;
        }
      }
    }
  }
}

TEST(Demand, LeavesACarThatStandsWhereItIs) {
  const auto state = after(prepare::default_car(), {-1.0, 0.5}, 0.0, 0.9, 1.0);
  EXPECT_EQ(norm(state.v_B), 0.0);
  EXPECT_EQ(state.X_WB.p, (Vec2{0.0, 0.0}));
}

TEST(Demand, AllocatesNothing) {
  const Car car = prepare::default_car();
  const std::size_t before = num_allocations;
  (void)after(car, {-0.7, 0.7}, 20.0, 0.9, 0.5);
  EXPECT_EQ(num_allocations - before, 0U);
}

}  // namespace
}  // namespace saca::manoeuvre::demand_test
