#include "saca/onboard/atlas/atlas_identity.h"

#include <gtest/gtest.h>

#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::atlas::atlas_identity_test {
namespace {

TEST(AtlasIdentity, HashesTellCarsTuningsAndGridsApart) {
  const manoeuvre::Car car = small_atlas_car();
  manoeuvre::Car heavier = car;
  heavier.mass *= 1.0 + 1e-15;
  manoeuvre::Car tuned = car;
  tuned.tuning.swerve.damping += 0.01;
  manoeuvre::Car bounded = car;
  bounded.tuning.domain.slowest[3] += 0.5;
  EXPECT_EQ(car_hash(car), car_hash(manoeuvre::Car(car)));
  EXPECT_NE(car_hash(car), car_hash(heavier));
  EXPECT_NE(car_hash(car), car_hash(tuned));
  EXPECT_NE(car_hash(car), car_hash(bounded));
  AtlasGrid other = small_grid();
  other[0].speeds.push_back(14.0);
  EXPECT_NE(grid_hash(small_grid()), grid_hash(other));
}

// A controller that steers a little otherwise is another one, whoever forgot to say so.
TEST(AtlasIdentity, BehaviourShowsAControllerThatDrivesOtherwise) {
  const Behaviour now = behaviour(small_atlas_car());
  EXPECT_TRUE(alike(now, behaviour(small_atlas_car())));
  manoeuvre::Car swerves = small_atlas_car();
  swerves.tuning.swerve.damping *= 0.97;
  EXPECT_FALSE(alike(now, behaviour(swerves)));
  manoeuvre::Car drifts_on = small_atlas_car();
  drifts_on.tuning.drift.gain *= 0.97;
  EXPECT_FALSE(alike(now, behaviour(drifts_on)));
  manoeuvre::Car brakes = small_atlas_car();
  brakes.brake_lag += 0.005;
  EXPECT_FALSE(alike(now, behaviour(brakes)));
}

}  // namespace
}  // namespace saca::atlas::atlas_identity_test
