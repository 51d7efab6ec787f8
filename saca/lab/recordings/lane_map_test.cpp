#include "saca/lab/recordings/lane_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saca::recordings::lane_map_test {
namespace {

/// A straight lanelet along x from x = `from` to `to`, its centre at `y`.
Lanelet straight_lane(std::int64_t id, double from, double to, double y, double width = 3.5) {
  Lanelet lanelet{.id = id};
  for (const double x : {from, 0.5 * (from + to), to}) {
    lanelet.left_W.push_back({x, y + 0.5 * width});
    lanelet.right_W.push_back({x, y - 0.5 * width});
  }
  return lanelet;
}

/// Two lanes side by side, each of two lanelets of 50 m: 1 then 2 on the right, 11 then 12 on the
/// left.
CommonRoad two_lanes() {
  CommonRoad file;
  file.lanelets = {straight_lane(1, 0.0, 50.0, 0.0), straight_lane(2, 50.0, 100.0, 0.0),
                   straight_lane(11, 0.0, 50.0, 3.5), straight_lane(12, 50.0, 100.0, 3.5)};
  file.lanelets[0].successors = {2};
  file.lanelets[1].predecessors = {1};
  file.lanelets[2].successors = {12};
  file.lanelets[3].predecessors = {11};
  file.lanelets[0].left = Neighbour{11, true};
  file.lanelets[1].left = Neighbour{12, true};
  file.lanelets[2].right = Neighbour{1, true};
  file.lanelets[3].right = Neighbour{2, true};
  return file;
}

std::int64_t id_of(const LaneMap& map, const LanePlace& place) {
  return map.lanelets()[place.lanelet].id;
}

/// Moves all of a map.
CommonRoad moved(CommonRoad file, const Pose& X_VW) {
  for (Lanelet& lanelet : file.lanelets) {
    for (Vec2& p : lanelet.left_W) {
      p = X_VW * p;
    }
    for (Vec2& p : lanelet.right_W) {
      p = X_VW * p;
    }
  }
  return file;
}

TEST(LaneMap, TellsWhereABodyIsInItsLane) {
  const LaneMap map(two_lanes());
  const auto places = map.places({{20.0, 0.7}, 0.1});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(id_of(map, places[0]), 1);
  EXPECT_NEAR(places[0].along, 20.0, 1e-9);
  EXPECT_NEAR(places[0].offset, 0.7, 1e-9);
  EXPECT_NEAR(places[0].heading, 0.1, 1e-9);
  EXPECT_NEAR(places[0].width, 3.5, 1e-9);
  EXPECT_NEAR(places[0].curvature, 0.0, 1e-9);
}

TEST(LaneMap, IsTheSameInATurnedWorld) {
  const Pose X_VW{{5e5, -4e6}, 2.5};
  const LaneMap map(moved(two_lanes(), X_VW));
  const auto places = map.places(X_VW * Pose{{20.0, -0.7}, -0.1});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_NEAR(places[0].along, 20.0, 1e-6);  // rounding of coordinates of 4e6 m
  EXPECT_NEAR(places[0].offset, -0.7, 1e-6);
  EXPECT_NEAR(places[0].heading, -0.1, 1e-6);
}

TEST(LaneMap, HoldsNobodyOutsideAgainstTheWayOrBeyondTheEnd) {
  const LaneMap map(two_lanes());
  EXPECT_TRUE(map.places({{20.0, -1.8}, 0.0}).empty());
  EXPECT_TRUE(map.places({{20.0, 5.3}, 0.0}).empty());
  EXPECT_TRUE(map.places({{20.0, 0.0}, std::numbers::pi}).empty());
  EXPECT_TRUE(map.places({{101.0, 0.0}, 0.0}).empty());
  EXPECT_TRUE(map.places({{-1.0, 0.0}, 0.0}).empty());
  EXPECT_TRUE(map.places({{NAN, 0.0}, 0.0}).empty());
  EXPECT_TRUE(map.places({{20.0, 0.0}, NAN}).empty());
}

TEST(LaneMap, MeasuresCurvatureAndHeadingOfAnArc) {
  constexpr double radius = 100.0;
  Lanelet lanelet{.id = 1};
  for (int k = 0; k <= 100; ++k) {  // a quarter of a circle to the left
    const double angle = 0.5 * std::numbers::pi * k / 100.0;
    const Vec2 out = rotated({0.0, -1.0}, angle);
    lanelet.left_W.push_back((radius - 1.75) * out);
    lanelet.right_W.push_back((radius + 1.75) * out);
  }
  CommonRoad file;
  file.lanelets = {lanelet};
  const LaneMap map(file);
  const double angle = 0.7;
  const Vec2 out = rotated({0.0, -1.0}, angle);
  const auto places = map.places({(radius - 0.5) * out, angle});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_NEAR(places[0].curvature, 1.0 / radius, 1e-4);
  EXPECT_NEAR(places[0].heading, 0.0, 1e-3);
  // Chords of 1.6 m and of 1 m lie up to 1.6^2 / (8 R) inside the arc.
  EXPECT_NEAR(places[0].offset, 0.5, 5e-3);
  EXPECT_NEAR(places[0].along, radius * angle, 0.01);
}

TEST(LaneMap, CurvatureGoesOnAcrossLanelets) {
  // Straight, then an arc of 50 m radius: just before the seam half of the 20 m are in the arc.
  Lanelet arc{.id = 2};
  for (int k = 0; k <= 60; ++k) {
    const double angle = 0.02 * k;
    const Vec2 out = rotated({0.0, -1.0}, angle);
    arc.left_W.push_back(Vec2{50.0, 50.0} + 48.25 * out);
    arc.right_W.push_back(Vec2{50.0, 50.0} + 51.75 * out);
  }
  CommonRoad file;
  file.lanelets = {straight_lane(1, 0.0, 50.0, 0.0), arc};
  file.lanelets[0].successors = {2};
  file.lanelets[1].predecessors = {1};
  const LaneMap map(file);
  const auto before = map.places({{49.9, 0.0}, 0.0});
  const auto after = map.places({{50.4, 0.0}, 0.0});
  ASSERT_FALSE(before.empty());
  ASSERT_FALSE(after.empty());
  EXPECT_EQ(id_of(map, before[0]), 1);
  EXPECT_NEAR(before[0].curvature, 0.5 / 50.0, 2e-3);
  EXPECT_NEAR(after.back().curvature, before[0].curvature, 1e-3);
}

/// Follows a body through positions along y; x grows by 1 m.
std::vector<LaneSighting> followed(const LaneMap& map, const std::vector<double>& ys,
                                   double x = 5.0) {
  std::vector<LaneSighting> sightings;
  std::optional<LanePlace> last;
  for (const double y : ys) {
    sightings.push_back(map.follow(last, {{x, y}, 0.0}));
    last = sightings.back().place;
    x += 1.0;
  }
  return sightings;
}

TEST(LaneMap, CountsALaneChangeWhenTheCentreHasCrossed) {
  const LaneMap map(two_lanes());
  // The bound is at 1.75; within 0.3 m beyond it the lane is kept.
  const auto left = followed(map, {0.0, 1.7, 2.0, 2.1, 3.5});
  EXPECT_EQ(left[2].lane_step, 0);
  EXPECT_NEAR(left[2].place->offset, 2.0, 1e-9);
  EXPECT_EQ(left[3].lane_step, 1);
  EXPECT_EQ(id_of(map, *left[3].place), 11);
  EXPECT_NEAR(left[3].place->offset, 2.1 - 3.5, 1e-9);
  EXPECT_EQ(left[4].lane_step, 0);
  const auto right = followed(map, {3.5, 1.8, 1.5, 1.4, 0.0});
  EXPECT_EQ(right[2].lane_step, 0);
  EXPECT_EQ(right[3].lane_step, -1);
}

TEST(LaneMap, NoiseOnTheBoundIsNoLaneChange) {
  const LaneMap map(two_lanes());
  for (const LaneSighting& sighting : followed(map, {1.6, 1.9, 1.6, 2.0, 1.5, 1.8, 2.04})) {
    EXPECT_EQ(sighting.lane_step, 0);
    EXPECT_EQ(id_of(map, sighting.place.value()), 1);
  }
}

TEST(LaneMap, ALaneGoesOnInItsSuccessor) {
  const LaneMap map(two_lanes());
  const auto along = followed(map, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 47.5);
  for (const LaneSighting& sighting : along) {
    EXPECT_EQ(sighting.lane_step, 0);
    ASSERT_TRUE(sighting.place);
  }
  EXPECT_EQ(id_of(map, *along.front().place), 1);
  EXPECT_EQ(id_of(map, *along.back().place), 2);
  // A change at the seam: from lanelet 1 into the neighbour of its successor.
  const auto change = followed(map, {1.7, 2.2}, 49.5);
  EXPECT_EQ(change[1].lane_step, 1);
}

TEST(LaneMap, FindsANeighbourThatTheMapDoesNotName) {
  CommonRoad file = two_lanes();
  for (Lanelet& lanelet : file.lanelets) {
    lanelet.left.reset();
    lanelet.right.reset();
  }
  const LaneMap map(file);
  EXPECT_EQ(followed(map, {1.7, 2.2})[1].lane_step, 1);
  EXPECT_EQ(followed(map, {1.8, 1.2})[1].lane_step, -1);
}

TEST(LaneMap, LanesThatOverlapAreNoNeighbours) {
  CommonRoad file;
  file.lanelets = {straight_lane(1, 0.0, 50.0, 0.0), straight_lane(2, 0.0, 50.0, 1.5)};
  const LaneMap map(file);
  const auto moved_over = followed(map, {0.0, 2.3});
  EXPECT_EQ(id_of(map, moved_over[1].place.value()), 2);
  EXPECT_EQ(moved_over[1].lane_step, 0);
}

TEST(LaneMap, IsLostOffTheRoadAndFoundAgain) {
  const LaneMap map(two_lanes());
  const auto off = followed(map, {0.0, -2.5, 0.0});
  EXPECT_TRUE(off[0].place);
  EXPECT_FALSE(off[1].place);
  EXPECT_TRUE(off[2].place);
  EXPECT_EQ(off[2].lane_step, 0);
}

TEST(LaneMap, TheWayAheadForksAndEnds) {
  CommonRoad file = two_lanes();
  file.lanelets[0].successors = {2, 12};
  const LaneMap map(file);
  const LanePlace from = map.places({{20.0, 0.0}, 0.0}).at(0);
  const LaneMap::Way far = map.way_ahead(from, 100.0);
  ASSERT_EQ(far.lanelets.size(), 3U);
  EXPECT_NEAR(far.lanelets[0].way, -20.0, 1e-9);
  EXPECT_NEAR(far.lanelets[1].way, 30.0, 1e-9);
  EXPECT_NEAR(far.lanelets[2].way, 30.0, 1e-9);
  EXPECT_NEAR(far.end, 80.0, 1e-9);
  const LaneMap::Way near = map.way_ahead(from, 25.0);
  EXPECT_EQ(near.lanelets.size(), 1U);
  EXPECT_NEAR(near.end, 25.0, 1e-9);
}

TEST(LaneMap, EndsInAMapThatRunsInACircle) {
  CommonRoad file = two_lanes();
  file.lanelets[1].successors = {1};
  const LaneMap map(file);
  const LanePlace from = map.places({{20.0, 0.0}, 0.0}).at(0);
  EXPECT_EQ(map.way_ahead(from, 1e6).lanelets.size(), 2U);
}

TEST(LaneMap, TakesAMapThatIsFarTooLarge) {
  CommonRoad file;
  file.lanelets = {straight_lane(1, -1e8, 1e8, 0.0)};
  const LaneMap map(file);
  EXPECT_LE(map.lanelets().at(0).points_W.size(), 5001U);
  EXPECT_NEAR(map.places({{12345.0, 0.5}, 0.0}).at(0).offset, 0.5, 1e-6);
}

TEST(LaneMap, PassesOverLaneletsWithoutLength) {
  CommonRoad file;
  file.lanelets = {straight_lane(1, 3.0, 3.0, 0.0)};
  const LaneMap map(file);
  EXPECT_TRUE(map.lanelets().empty());
  EXPECT_FALSE(map.follow(std::nullopt, {{3.0, 0.0}, 0.0}).place);
}

}  // namespace
}  // namespace saca::recordings::lane_map_test
