#include "saca/base/world/road.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace saca::world::road_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Road, AStraightLaneIsARotatedFrame) {
  Road road;
  road.X_WL = {{10.0, 20.0}, pi / 2.0};  // north
  const LanePose pose = to_lane(road, {{9.0, 25.0}, pi / 2.0 + 0.1});
  EXPECT_NEAR(pose.s, 5.0, 1e-12);
  EXPECT_NEAR(pose.d, 1.0, 1e-12);  // west of a northbound lane is its left
  EXPECT_NEAR(pose.heading, 0.1, 1e-12);
}

// A quarter of a circle of radius 100 m to the left ends at (100, 100), facing north.
TEST(Road, AQuarterCircleEndsWhereGeometrySays) {
  Road road;
  road.curvature = 0.01;
  const Pose end = from_lane(road, {.s = 50.0 * pi});
  EXPECT_NEAR(end.p.x, 100.0, 1e-9);
  EXPECT_NEAR(end.p.y, 100.0, 1e-9);
  EXPECT_NEAR(end.yaw, pi / 2.0, 1e-12);
  // Two metres to the left of that is two metres nearer to the circle's centre (0, 100).
  EXPECT_NEAR(from_lane(road, {.s = 50.0 * pi, .d = 2.0}).p.x, 98.0, 1e-9);
}

TEST(Road, LaneAndWorldAreInverse) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    Road road;
    road.X_WL = {{50.0 * u(rng), 50.0 * u(rng)}, pi * u(rng)};
    road.curvature = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.01 * u(rng) : 1e-9 * u(rng);
    const LanePose pose{80.0 * u(rng), 10.0 * u(rng), u(rng)};
    const LanePose back = to_lane(road, from_lane(road, pose));
    EXPECT_NEAR(back.s, pose.s, 1e-8);
    EXPECT_NEAR(back.d, pose.d, 1e-9);
    EXPECT_NEAR(back.heading, pose.heading, 1e-9);
  }
}

TEST(Road, LeftAndRightAreMirrorImages) {
  Road left;
  left.curvature = 0.008;
  Road right;
  right.curvature = -0.008;
  const Pose a = from_lane(left, {40.0, 1.5, 0.2});
  const Pose b = from_lane(right, {40.0, -1.5, -0.2});
  EXPECT_NEAR(a.p.x, b.p.x, 1e-12);
  EXPECT_NEAR(a.p.y, -b.p.y, 1e-12);
  EXPECT_NEAR(a.yaw, -b.yaw, 1e-12);
}

TEST(Road, NamesGoThereAndBack) {
  EXPECT_EQ(beyond_from(name(Beyond::barrier)), Beyond::barrier);
  EXPECT_EQ(topology_from(name(Topology::one_way)), Topology::one_way);
  EXPECT_EQ(beyond_from("lava"), std::nullopt);
}

}  // namespace
}  // namespace saca::world::road_test
