#include "saca/onboard/forecast/atlas_way.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "tests/support/count_allocations.h"

namespace saca::forecast::atlas_way_test {
namespace {

using atlas::atlas_plan;
using atlas::atlas_scene;
using atlas::small_atlas;
using atlas::small_atlas_car;
using manoeuvre::PolicyId;

// The atlas' error between its nodes is some centimetres (docs/decisions/0013).
TEST(AtlasWay, IsWhereTheCarDrives) {
  world::Scene scene = atlas_scene(12.5, 0.85);
  scene.time = 3.0;
  scene.ego.X_WB = {{7.0, -2.0}, 0.5};
  scene.road.X_WL = scene.ego.X_WB;
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::aes_left, PolicyId::t_drift_right}) {
    const manoeuvre::Plan plan = atlas_plan(policy, 12.5);
    world::Track way;
    atlas_way(small_atlas(), plan, scene, usual_way, way);
    const auto driven = drive(small_atlas_car(), plan, scene, scene.grip, 20.0);
    EXPECT_EQ(way.start, 3.0);
    EXPECT_GE(end_time(way), end_time(driven.track) - 0.1);
    for (double time = 3.0; time < end_time(driven.track); time += 0.05) {
      const Vec2 off = pose_at(way, time).p - pose_at(driven.track, time).p;
      EXPECT_LT(norm(off), 0.15) << manoeuvre::name(policy) << time;
    }
  }
}

// Who has recovered a lane goes on along it, so that nobody behind takes it to stop there.
TEST(AtlasWay, GoesOnBeyondARecoveredLane) {
  const world::Scene scene = atlas_scene(12.5, 0.85);
  const manoeuvre::Plan plan = atlas_plan(PolicyId::aes_left, 12.5);
  world::Track way;
  atlas_way(small_atlas(), plan, scene, usual_way, way);
  const auto driven = drive(small_atlas_car(), plan, scene, scene.grip, 20.0);
  EXPECT_NEAR(end_time(way), end_time(driven.track) + 2.0, 0.2);
  EXPECT_NEAR(velocity_at(way, end_time(way) - 0.02).x, 12.4, 0.3);
}

TEST(AtlasWay, IsCutWhereAskedAndAllocatesNothing) {
  const world::Scene scene = atlas_scene(12.5, 0.85);
  const manoeuvre::Plan plan = atlas_plan(PolicyId::no_intervention, 12.5);
  world::Track way;
  way.X_WA.reserve(42);
  const std::size_t before = num_allocations;
  atlas_way(small_atlas(), plan, scene, {.step = 0.1, .longest = 4.0}, way);
  EXPECT_EQ(num_allocations, before);
  EXPECT_EQ(way.X_WA.size(), 41U);
  EXPECT_THROW(atlas_way(small_atlas(), plan, scene, {.step = 0.0, .longest = 4.0}, way),
               ContractViolation);
}

}  // namespace
}  // namespace saca::forecast::atlas_way_test
