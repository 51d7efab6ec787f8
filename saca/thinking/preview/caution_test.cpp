#include "saca/thinking/preview/caution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::preview::caution_test {
namespace {

using intent::Beliefs;
using intent::Intention;
using intent::IntentPosterior;
using world::Actor;
using world::Scene;

Scene ego_and(Vec2 p_W, Vec2 v_W) {
  Scene scene = test::ego_at(14.0, test::whole_metres);
  scene.actors.push_back(test::block(1, p_W, v_W));
  return scene;
}

IntentPosterior prepared_for(const Scene& scene, const IntentPosterior& posterior) {
  Beliefs beliefs;
  beliefs.push_back({});
  beliefs[0].at.fill(posterior);
  const Beliefs found = cautious(scene, beliefs, {});
  EXPECT_EQ(found[0].at[1], found[0].at[0]);
  EXPECT_EQ(found[0].at[2], found[0].at[0]);
  return found[0].now();
}

constexpr IntentPosterior sure{1.0};

// A lead 2 s ahead that brakes as people usually do can be followed at any speed; one that brakes
// hard cannot.
TEST(HardDriving, IsHarderThanUsualAndAsUncertain) {
  const intent::MotionLaw usual;
  const intent::MotionLaw hard = hard_driving();
  const Scene scene = ego_and({40.0, 0.0}, {20.0, 0.0});
  const auto way = [&](const intent::MotionLaw& law) {
    return motion_under(scene, scene.actors[0], Intention::brake, 5.0, law).track.X_WA.back().p.x;
  };
  EXPECT_LT(way(hard), way(usual) - 20.0);
  EXPECT_EQ(hard.braking_log_sd, usual.braking_log_sd);
  EXPECT_EQ(hard.driving.sd, usual.driving.sd);
}

TEST(Cautious, WhoCrossesBrakesWithTenPercent) {
  const IntentPosterior p =
      prepared_for(ego_and({55.0, 43.0}, {0.0, -7.5}), {0.8, 0.1, 0.06, 0.04});
  EXPECT_NEAR(p[3], 0.10, 1e-12);
  // The rest, 0.96, shrinks to 0.90 in proportion.
  EXPECT_NEAR(p[0], 0.8 * 0.90 / 0.96, 1e-12);
  EXPECT_NEAR(p[1], 0.1 * 0.90 / 0.96, 1e-12);
  EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
}

TEST(Cautious, BrakingWhileMovingAsideIsBraking) {
  const Scene scene = ego_and({55.0, 43.0}, {0.0, -7.5});
  const IntentPosterior enough{0.9, 0.0, 0.0, 0.0, 0.06, 0.04};
  EXPECT_EQ(prepared_for(scene, enough), enough);
  const IntentPosterior p = prepared_for(scene, {0.94, 0.0, 0.0, 0.0, 0.04, 0.02});
  EXPECT_NEAR(p[3] + p[4] + p[5], 0.10, 1e-12);
}

TEST(Cautious, WhoIsInConflictBrakesWithSixPercent) {
  EXPECT_NEAR(prepared_for(ego_and({40.0, 0.0}, {6.0, 0.0}), sure)[3], 0.06,
              1e-12);  // 36 m at 8 m/s
}

TEST(Cautious, WhatItPreparesForCounts) {
  EXPECT_GT(Caution().other, reflex::Thresholds().least_posterior);
  EXPECT_GT(Caution().crossing, reflex::Thresholds().least_posterior);
}

TEST(Cautious, AWalkerStopsInsteadOfBraking) {
  Scene scene = ego_and({55.0, 6.0}, {0.0, -1.4});
  scene.actors[0].kind = world::ActorKind::pedestrian;
  IntentPosterior walks{};
  walks[static_cast<std::size_t>(Intention::cross)] = 1.0;
  const IntentPosterior p = prepared_for(scene, walks);
  EXPECT_NEAR(p[static_cast<std::size_t>(Intention::stop)], 0.10, 1e-12);
  EXPECT_NEAR(p[static_cast<std::size_t>(Intention::cross)], 0.90, 1e-12);
  EXPECT_EQ(p[static_cast<std::size_t>(Intention::brake)], 0.0);
}

TEST(Cautious, OthersAreBelieved) {
  EXPECT_EQ(prepared_for(ego_and({40.0, 0.0}, {14.0, 0.0}), sure), sure);   // keeps its distance
  EXPECT_EQ(prepared_for(ego_and({40.0, 3.5}, {-14.0, 0.0}), sure), sure);  // in a lane of its own
  EXPECT_EQ(prepared_for(ego_and({40.0, 0.0}, {0.0, 0.0}), sure), sure);    // at rest
}

TEST(Cautious, RefusesBeliefsAboutOthers) {
  EXPECT_THROW((void)cautious(ego_and({40.0, 0.0}, {6.0, 0.0}), Beliefs(), {}), ContractViolation);
}

}  // namespace
}  // namespace saca::preview::caution_test
