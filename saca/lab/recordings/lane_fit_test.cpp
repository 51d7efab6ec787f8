#include "saca/lab/recordings/lane_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace saca::recordings::lane_fit_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A lanelet along an arc from s = `from` to `to`, against it where that is less, its centre `d` to
/// the left of the arc's.
Lanelet arc_lanelet(std::int64_t id, const world::Road& arc, double from, double to, double d,
                    double width) {
  Lanelet lanelet{.id = id};
  constexpr int pieces = 60;
  for (int k = 0; k <= pieces; ++k) {
    const double s = from + static_cast<double>(k) / pieces * (to - from);
    const double side = std::copysign(0.5 * width, to - from);
    lanelet.left_W.push_back(from_lane(arc, {s, d + side, 0.0}).p);
    lanelet.right_W.push_back(from_lane(arc, {s, d - side, 0.0}).p);
  }
  return lanelet;
}

world::Road arc_of(double curvature) {
  world::Road arc;
  arc.X_WL = {{40.0, -25.0}, 2.5};
  arc.curvature = curvature;
  return arc;
}

TEST(FitLane, FindsTheArcOnWhichTheLaneWasDrawn) {
  for (const double curvature : {0.0, 0.002, -0.01, 0.02}) {
    const world::Road arc = arc_of(curvature);
    CommonRoad file;
    file.lanelets = {arc_lanelet(1, arc, -30.0, 40.0, 0.0, 3.4),
                     arc_lanelet(2, arc, 40.0, 120.0, 0.0, 3.4)};
    file.lanelets[0].successors = {2};
    file.lanelets[1].predecessors = {1};
    const auto fit = fit_lane(file, from_lane(arc, {5.0, 0.8, 0.05}), {});
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    const world::Road& road = fit.value().road;
    // Chords of 1.3 m on a circle of 50 m or more miss it by less than 1.3^2 / (8 * 50) = 4 mm.
    EXPECT_NEAR(road.curvature, curvature, 1e-5);
    EXPECT_LT(fit.value().largest, 0.005);
    EXPECT_NEAR(road.lane_width, 3.4, 0.01);
    EXPECT_NEAR(road.left_edge, 1.7, 0.01);
    EXPECT_NEAR(road.right_edge, -1.7, 0.01);
    const world::LanePose start = to_lane(road, from_lane(arc, {5.0, 0.8, 0.05}));
    EXPECT_NEAR(start.s, 0.0, 1e-6);  // the road begins beside the start
    EXPECT_NEAR(start.d, 0.8, 0.01);
    EXPECT_NEAR(start.heading, 0.05, 1e-3);
    EXPECT_NEAR(fit.value().behind, 20.0, 1.0);
    EXPECT_NEAR(fit.value().ahead, 100.0, 1.0);
    EXPECT_THAT(fit.value().lanelets, ElementsAre(1, 2));
  }
}

/// Four lanes: 10 (ours), 11 to its right the same way, 12 and 13 to its left the other way.
CommonRoad four_lanes() {
  const world::Road arc = arc_of(0.001);
  CommonRoad file;
  file.lanelets = {
      arc_lanelet(10, arc, -30.0, 120.0, 0.0, 3.5), arc_lanelet(11, arc, -30.0, 120.0, -3.5, 3.5),
      arc_lanelet(12, arc, 120.0, -30.0, 3.5, 3.5), arc_lanelet(13, arc, 120.0, -30.0, 7.0, 3.5)};
  file.lanelets[0].left = Neighbour{12, false};
  file.lanelets[0].right = Neighbour{11, true};
  file.lanelets[1].left = Neighbour{10, true};
  file.lanelets[2].left = Neighbour{10, false};
  file.lanelets[2].right = Neighbour{13, true};
  file.lanelets[3].left = Neighbour{12, true};
  return file;
}

TEST(FitLane, KnowsEdgesAndOncomingLanes) {
  const CommonRoad file = four_lanes();
  const auto fit = fit_lane(file, from_lane(arc_of(0.001), {0.0, 0.0, 0.0}), {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit.value().road.left_edge, 8.75, 0.02);
  EXPECT_NEAR(fit.value().road.right_edge, -5.25, 0.02);
  EXPECT_TRUE(fit.value().road.oncoming_left);
  EXPECT_FALSE(fit.value().road.oncoming_right);
  // The same road driven the other way: mirrored.
  const auto back = fit_lane(file, from_lane(arc_of(0.001), {100.0, 3.5, std::numbers::pi}), {});
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back.value().road.left_edge, 8.75, 0.02);
  EXPECT_NEAR(back.value().road.right_edge, -5.25, 0.02);
  EXPECT_TRUE(back.value().road.oncoming_left);
  EXPECT_NEAR(back.value().road.curvature, -0.001 / (1.0 - 0.001 * 3.5), 1e-5);
}

/// A lane that goes straight on (2) or turns left (3) after 20 m.
CommonRoad fork() {
  const world::Road straight = arc_of(0.0);
  world::Road left = straight;
  left.X_WL = from_lane(straight, {20.0, 0.0, 0.0});
  left.curvature = 0.03;
  CommonRoad file;
  file.lanelets = {arc_lanelet(1, straight, -30.0, 20.0, 0.0, 3.5),
                   arc_lanelet(2, straight, 20.0, 120.0, 0.0, 3.5),
                   arc_lanelet(3, left, 0.0, 40.0, 0.0, 3.5)};
  file.lanelets[0].successors = {3, 2};
  return file;
}

TEST(FitLane, GoesStraightOnWhenNobodyKnowsTheWay) {
  const auto fit = fit_lane(fork(), from_lane(arc_of(0.0), {10.0, 0.0, 0.0}), {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_THAT(fit.value().lanelets, ElementsAre(1, 2));
  EXPECT_NEAR(fit.value().road.curvature, 0.0, 1e-9);
}

TEST(FitLane, FollowsTheWayThatWasRecorded) {
  const CommonRoad file = fork();
  std::vector<Vec2> way_W;
  for (std::size_t k = 0; k < file.lanelets[2].left_W.size(); ++k) {
    way_W.push_back(0.5 * (file.lanelets[2].left_W[k] + file.lanelets[2].right_W[k]));
  }
  const auto fit = fit_lane(file, from_lane(arc_of(0.0), {14.0, 0.0, 0.0}), way_W);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit.value().lanelets.back(), 3);
  EXPECT_GT(fit.value().road.curvature, 0.01);
  // A straight piece and a bend are no arc: the stretch is shorter, and the error is told.
  EXPECT_LT(fit.value().ahead, 45.0);
  EXPECT_GT(fit.value().largest, 0.01);
}

TEST(FitLane, RefusesWhatIsNoLane) {
  const world::Road arc = arc_of(0.0);
  const auto message = [](const CommonRoad& file, const Pose& start_W) {
    const auto fit = fit_lane(file, start_W, {});
    return fit.has_value() ? std::string("none") : fit.error().message;
  };
  const CommonRoad file = fork();
  EXPECT_THAT(message(file, from_lane(arc, {0.0, 9.0, 0.0})), HasSubstr("got one in none"));
  EXPECT_THAT(message(file, from_lane(arc, {0.0, 0.0, std::numbers::pi})),
              HasSubstr("got one in none"));
  EXPECT_THAT(message(file, from_lane(arc, {112.0, 0.0, 0.0})), HasSubstr("15 m of mapped lane"));
  CommonRoad narrow;
  narrow.lanelets = {arc_lanelet(1, arc, -30.0, 120.0, 0.0, 1.5)};
  EXPECT_THAT(message(narrow, from_lane(arc, {0.0, 0.0, 0.0})), HasSubstr("width of 1.5"));
  CommonRoad point;
  point.lanelets = {
      {.id = 1, .left_W = {{0.0, 0.0}, {0.0, 0.0}}, .right_W = {{0.0, 0.0}, {0.0, 0.0}}}};
  EXPECT_THAT(message(point, {}), HasSubstr("15 m of mapped lane"));
}

// Maps that lead back to where they began, along the road or across it: each piece of lane counts
// once, so the search ends, and what it finds is told as it would be of the same lane laid out
// once.
TEST(FitLane, IsNotCaughtInACircle) {
  const world::Road arc = arc_of(0.0);
  const Pose start_W = from_lane(arc, {0.2, 0.0, 0.0});
  CommonRoad short_circle;
  short_circle.lanelets = {arc_lanelet(1, arc, 0.0, 0.5, 0.0, 3.5)};
  short_circle.lanelets[0].successors = short_circle.lanelets[0].predecessors = {1};
  short_circle.lanelets[0].left = short_circle.lanelets[0].right = Neighbour{1, true};
  const auto refused = fit_lane(short_circle, start_W, {});
  ASSERT_FALSE(refused.has_value()) << "half a metre of lane";
  EXPECT_EQ(refused.error().code, Error::Code::out_of_range);
  EXPECT_THAT(refused.error().message, HasSubstr("15 m of mapped lane"));

  CommonRoad long_circle;
  long_circle.lanelets = {arc_lanelet(1, arc, -5.0, 40.0, 0.0, 3.5)};
  const auto laid_out_once = fit_lane(long_circle, start_W, {});
  long_circle.lanelets[0].successors = long_circle.lanelets[0].predecessors = {1};
  long_circle.lanelets[0].left = long_circle.lanelets[0].right = Neighbour{1, true};
  const auto fit = fit_lane(long_circle, start_W, {});
  ASSERT_TRUE(laid_out_once.has_value()) << laid_out_once.error().message;
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  EXPECT_THAT(fit.value().lanelets, ElementsAre(1));
  EXPECT_EQ(fit.value().ahead, laid_out_once.value().ahead);
  EXPECT_NEAR(fit.value().road.curvature, 0.0, 1e-6);
  EXPECT_NEAR(fit.value().road.left_edge, 1.75, 0.01);
  EXPECT_NEAR(fit.value().road.right_edge, -1.75, 0.01);
}

}  // namespace
}  // namespace saca::recordings::lane_fit_test
