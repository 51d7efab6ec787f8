#include "saca/onboard/atlas/atlas_point.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::atlas::atlas_point_test {
namespace {

// Shares change first, then ways, grips and speeds; kind after kind.
TEST(AtlasPoint, CountsThroughTheGrid) {
  const AtlasGrid grid = small_grid();
  const AtlasPoint first = point_of(grid, 0);
  EXPECT_EQ(first.kind, AtlasKind::stop);
  EXPECT_EQ(first.speed, 12.0);
  EXPECT_EQ(first.grip, 0.8);
  EXPECT_EQ(first.share, grid[0].shares[0]);
  EXPECT_EQ(point_of(grid, 1).share, grid[0].shares[1]);
  EXPECT_EQ(point_of(grid, grid[0].shares.size()).grip, 0.9);
  EXPECT_EQ(point_of(grid, grid[0].num_nodes()).kind, AtlasKind::keep);
  const AtlasPoint last = point_of(grid, num_nodes(grid) - 1);
  EXPECT_EQ(last.kind, AtlasKind::drift);
  EXPECT_EQ(last.speed, 13.0);
  EXPECT_EQ(last.grip, 0.9);
  EXPECT_THROW(std::ignore = point_of(grid, num_nodes(grid)), ContractViolation);
}

TEST(AtlasPoint, IsDrivenToTheLeft) {
  EXPECT_EQ(plan_of({.kind = AtlasKind::stop, .share = 0.6}).strength, 0.6);
  EXPECT_EQ(plan_of({.kind = AtlasKind::keep}).policy, manoeuvre::PolicyId::no_intervention);
  EXPECT_EQ(plan_of({.kind = AtlasKind::swerve}).policy, manoeuvre::PolicyId::aes_left);
  const manoeuvre::Plan braked =
      plan_of({.kind = AtlasKind::braked_swerve, .speed = 12.0, .share = 0.5});
  EXPECT_EQ(braked.policy, manoeuvre::PolicyId::es_b_left);
  EXPECT_EQ(braked.target_speed, 6.0);
  EXPECT_EQ(plan_of({.kind = AtlasKind::swerve_stop, .speed = 12.0}).target_speed, 0.0);
  EXPECT_EQ(plan_of({.kind = AtlasKind::drift}).policy, manoeuvre::PolicyId::t_drift_left);
}

// A way that no lane is wide enough for begins beside the middle of the widest.
TEST(AtlasPoint, BeginsSoThatItsWayIsDriven) {
  const manoeuvre::Car& car = small_atlas_car();
  const world::Scene usual = scene_of(car, {.speed = 12.0, .grip = 0.8, .way = 3.0});
  EXPECT_EQ(usual.road.lane_width, 3.0);
  EXPECT_EQ(usual.ego.X_WB.p.y, 0.0);
  EXPECT_EQ(usual.ego.v_B.x, 12.0);
  EXPECT_EQ(usual.grip, 0.8);
  const world::Scene wide = scene_of(car, {.speed = 12.0, .grip = 0.8, .way = 6.5});
  EXPECT_EQ(wide.road.lane_width, 6.0);
  EXPECT_EQ(wide.ego.X_WB.p.y, -0.5);
}

TEST(AtlasPoint, ATraceEndsWithItsDriveOrWhereItIsCut) {
  manoeuvre::EgoMotion motion;
  motion.track.step = 0.5;
  for (int i = 0; i <= 4; ++i) {
    motion.track.X_WA.push_back({{2.0 * i, 1.0}, 3.0 + 0.1 * i});  // beyond half a turn
    motion.v_B.push_back({4.0, 0.0});
    motion.yaw_rate.push_back(0.2);
  }
  motion.ended = true;
  const AtlasTrace whole = trace_of(motion, 10.0);
  EXPECT_TRUE(whole.ended);
  EXPECT_EQ(whole.end, 2.0);
  EXPECT_NEAR(whole.look.back()[2], 3.4, 1e-12);  // goes on growing
  EXPECT_EQ(whole.look.back()[1], 0.0);           // from where it began
  const AtlasTrace cut = trace_of(motion, 1.0);
  EXPECT_FALSE(cut.ended);
  EXPECT_EQ(cut.end, 1.0);
}

}  // namespace
}  // namespace saca::atlas::atlas_point_test
