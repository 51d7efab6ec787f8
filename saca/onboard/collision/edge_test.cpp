#include "saca/onboard/collision/edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::collision::edge_test {
namespace {

using world::Footprint;
using world::Road;
using world::Shape;

constexpr double pi = std::numbers::pi;
constexpr Footprint car{.length = 4.7, .width = 1.9};

world::Track moving(Pose X_WB, Vec2 v_W, double duration) {
  world::Track track;
  for (int k = 0; k <= static_cast<int>(std::lround(duration / 0.01)); ++k) {
    track.X_WA.push_back({X_WB.p + (0.01 * k) * v_W, X_WB.yaw});
  }
  return track;
}

TEST(Room, OnAStraightRoadByHand) {
  Road road;
  road.left_edge = 5.25;
  road.right_edge = -1.75;
  EXPECT_NEAR(edge_clearance(road, Side::left, car, {{30.0, 1.0}, 0.0}), 5.25 - 1.95, 1e-12);
  EXPECT_NEAR(edge_clearance(road, Side::right, car, {{30.0, 1.0}, 0.0}), 1.75 + 0.05, 1e-12);
  // Across the road: half its length to either side.
  EXPECT_NEAR(edge_clearance(road, Side::right, car, {{30.0, 0.0}, pi / 2.0}), 1.75 - 2.35, 1e-12);
}

// On a circle of 50 m about (0, 50): the inner long side is nearest in its middle, the outer
// corners are farthest.
TEST(Room, OnAnArcByHand) {
  Road road;
  road.curvature = 0.02;
  EXPECT_NEAR(edge_clearance(road, Side::left, car, {}), 1.75 - 0.95, 1e-9);
  EXPECT_NEAR(edge_clearance(road, Side::right, car, {}), 51.75 - std::hypot(50.0 + 0.95, 2.35),
              1e-9);
  road.curvature = -0.02;
  EXPECT_NEAR(edge_clearance(road, Side::right, car, {}), 1.75 - 0.95, 1e-9);
  EXPECT_NEAR(edge_clearance(road, Side::left, car, {}), 51.75 - std::hypot(50.95, 2.35), 1e-9);
}

// Oracle: dense boundary points put into the lane one by one.
TEST(Room, AgreesWithDenseSamplesOfTheBoundary) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    Road road;
    road.X_WL = {{5.0 * uniform(rng), 5.0 * uniform(rng)}, 3.0 * uniform(rng)};
    road.curvature = i % 3 == 0 ? 0.0 : 0.03 * uniform(rng);
    const Footprint body{.shape = i % 2 == 0 ? Shape::box : Shape::ellipse,
                         .length = 3.0 + 2.0 * uniform(rng),
                         .width = 1.5 + uniform(rng),
                         .centre_x = uniform(rng)};
    const Pose X_WB = from_lane(road, {30.0 * uniform(rng), 2.0 * uniform(rng), pi * uniform(rng)});
    double left = 100.0;
    double right = 100.0;
    for (int k = 0; k < 4000; ++k) {
      const double angle = k * pi / 2000.0;
      Vec2 p{0.5 * body.length * std::cos(angle), 0.5 * body.width * std::sin(angle)};
      if (body.shape == Shape::box) {  // the ray through the ellipse's point, out to the box
        const double out = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        p = (1.0 / out) * p;
      }
      const double d = to_lane(road, {X_WB * (p + Vec2{body.centre_x, 0.0}), 0.0}).d;
      left = std::min(left, road.left_edge - d);
      right = std::min(right, d - road.right_edge);
    }
    EXPECT_NEAR(edge_clearance(road, Side::left, body, X_WB), left, 1e-5) << i;
    EXPECT_NEAR(edge_clearance(road, Side::right, body, X_WB), right, 1e-5) << i;
  }
}

TEST(EdgeApproach, CrossesWhenTheFirstCornerDoes) {
  Road road;
  road.left_edge = 5.25;
  // Heading 0.1 rad to the left at 10 m/s: the front left corner leads.
  const Pose X_WB{{0.0, 0.0}, 0.1};
  const Vec2 v_W = rotated({10.0, 0.0}, 0.1);
  const EdgeApproach found = edge_approach(road, Side::left, car, moving(X_WB, v_W, 8.0), 100.0);
  const double reach = 2.35 * std::sin(0.1) + 0.95 * std::cos(0.1);
  ASSERT_TRUE(found.crossing);
  EXPECT_NEAR(*found.crossing, (5.25 - reach) / v_W.y, 1e-3 / 10.0);
  EXPECT_LE(found.clearance, 1e-12);
}

TEST(EdgeApproach, StayingInsideTellsTheSmallestRoom) {
  const Road road;
  const EdgeApproach found =
      edge_approach(road, Side::right, car, moving({{0.0, -0.3}, 0.0}, {20.0, 0.0}, 3.0), 100.0);
  EXPECT_FALSE(found.crossing);
  EXPECT_NEAR(found.clearance, 1.75 - 0.95 - 0.3, 1e-9);
}

TEST(EdgeApproach, StandingBeyondIsCrossingAtTheStart) {
  const Road road;
  const EdgeApproach found =
      edge_approach(road, Side::left, car, moving({{0.0, 1.5}, 0.0}, {1.0, 0.0}, 1.0), 100.0);
  EXPECT_EQ(found.crossing, 0.0);
}

TEST(EdgeApproach, IsTheSameMirrored) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 50; ++i) {
    Road road;
    road.curvature = 0.02 * uniform(rng);
    road.left_edge = 3.0;
    Road mirrored = road;
    mirrored.curvature = -road.curvature;
    mirrored.left_edge = 1.75;
    mirrored.right_edge = -3.0;
    const double heading = 0.3 * uniform(rng);
    const EdgeApproach left = edge_approach(
        road, Side::left, car, moving({{}, heading}, rotated({10.0, 0.0}, heading), 2.0), 100.0);
    const EdgeApproach right =
        edge_approach(mirrored, Side::right, car,
                      moving({{}, -heading}, rotated({10.0, 0.0}, -heading), 2.0), 100.0);
    ASSERT_EQ(left.crossing.has_value(), right.crossing.has_value()) << i;
    EXPECT_NEAR(left.crossing.value_or(0.0), right.crossing.value_or(0.0), 1e-7) << i;
    EXPECT_NEAR(left.clearance, right.clearance, 1e-7) << i;
  }
}

// Against the clearance at every millisecond, for bodies that spin and slide across bent roads,
// poses as far apart as those of a forecast.
TEST(EdgeApproach, MissesNoCrossing) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int crossings = 0;
  for (int i = 0; i < 200; ++i) {
    Road road;
    road.curvature = i % 3 == 0 ? 0.0 : 0.03 * uniform(rng);
    road.left_edge = 4.0 + 3.0 * uniform(rng);
    road.right_edge = -5.0 + 3.0 * uniform(rng);
    const Footprint body{.shape = i % 2 == 0 ? Shape::box : Shape::ellipse,
                         .length = 4.7,
                         .width = 1.9,
                         .centre_x = uniform(rng)};
    world::Track track{.start = 2.0, .step = i % 4 == 0 ? 0.01 : 0.05, .X_WA = {}};
    const Vec2 v_W{12.0 + 8.0 * uniform(rng), 4.0 * uniform(rng)};
    const double yaw = 3.0 * uniform(rng);
    const double yaw_rate = 4.0 * uniform(rng);
    for (int k = 0; k <= static_cast<int>(2.0 / track.step); ++k) {
      const double t = k * track.step;
      track.X_WA.push_back({(t - 0.15 * t * t) * v_W, wrap_angle(yaw + t * yaw_rate)});
    }
    const Side side = i % 5 < 2 ? Side::left : Side::right;
    double first = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 2000 && std::isinf(first); ++k) {
      const double time = 2.0 + 0.001 * k;
      first = edge_clearance(road, side, body, pose_at(track, time)) <= 0.0 ? time : first;
    }
    for (const double of_interest : {0.0, 100.0}) {
      const EdgeApproach found = edge_approach(road, side, body, track, of_interest);
      EXPECT_NEAR(found.crossing.value_or(9.0), std::min(first, 9.0), 0.011) << i;
    }
    crossings += std::isinf(first) ? 0 : 1;
  }
  EXPECT_GT(crossings, 40);
}

TEST(EdgeApproach, RefusesWhatIsNoRoad) {
  Road road;
  road.left_edge = -1.0;
  EXPECT_THROW((void)edge_clearance(road, Side::left, car, {}), ContractViolation);
  road.left_edge = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)edge_clearance(road, Side::left, car, {}), ContractViolation);
  EXPECT_THROW((void)edge_approach(Road{}, Side::left, car, world::Track{}, 1.0),
               ContractViolation);
}

}  // namespace
}  // namespace saca::collision::edge_test
