#include "saca/onboard/manoeuvre/ride.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::ride_test {
namespace {

using test::ego_alone;

constexpr Plan brake{PolicyId::aeb, std::nullopt};

double stop(double grip, const ParameterPerturbation& perturbation) {
  Ride ride(prepare::default_car(), brake, ego_alone(15.0, 0.8), grip, perturbation);
  while (!ride.ended()) {
    ride.step();
  }
  return ride.state().X_WB.p.x;
}

TEST(Ride, GoesTheWayOfDrive) {
  const Car car = prepare::default_car();
  const world::Scene scene = ego_alone(16.0, 0.8);
  const Plan plan = default_plan(PolicyId::es_b_left, 16.0);
  const EgoMotion motion = drive(car, plan, scene, 0.7, 1.0);
  Ride ride(car, plan, scene, 0.7);
  const std::size_t before = num_allocations;
  for (int i = 0; i < 1000; ++i) {
    ride.step();
  }
  EXPECT_EQ(num_allocations - before, 0U);
  EXPECT_EQ(ride.state().X_WB.p.y, motion.track.X_WA.back().p.y);
}

// v^2 / (2 mu g): a road that gives less takes longer, whatever the controller thinks.
TEST(Ride, TheRoadDecidesNotWhatIsKnownOfIt) {
  EXPECT_NEAR(stop(0.8, {.grip = 0.8}) / stop(0.8, {}), 1.0 / 0.8, 0.06);
  EXPECT_NEAR(stop(0.8, {.grip = 0.8}), stop(0.64, {}), 1e-9);
  EXPECT_GT(stop(0.8, {.speed = 1.0}), stop(0.8, {}) + 1.5);
}

TEST(Ride, NoDrawMakesTheRoadBetterThanTheModelKnows) {
  for (const double grip : {1.12, 1.17, 1.2}) {
    Ride ride(prepare::default_car(), brake, ego_alone(15.0, 0.9), grip, {.grip = 1.18});
    ride.step();
    EXPECT_GT(ride.state().X_WB.p.x, 0.0);
  }
}

TEST(Ride, RefusesWhatCannotBeDriven) {
  EXPECT_THROW(Ride(prepare::default_car(), brake, ego_alone(15.0, 0.8), 1.3), ContractViolation);
  EXPECT_THROW(
      Ride(prepare::default_car(), {PolicyId::es_b_left, std::nullopt}, ego_alone(15.0, 0.8), 0.8),
      ContractViolation);
}

}  // namespace
}  // namespace saca::manoeuvre::ride_test
