#include "saca/lab/report/value_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/thinking/danger/obstacle_frame.h"

namespace saca::report::value_map_test {
namespace {

using danger::Grid;
using danger::ValueTable;

// V = 5 - distance from (1, -2), and less by the third coordinate.
ValueTable cone() {
  const Grid grid{{{.name = "x", .first = -10.0, .last = 10.0, .points = 161},
                   {.name = "y", .first = -10.0, .last = 10.0, .points = 161},
                   {.name = "z", .first = 0.0, .last = 2.0, .points = 4}}};
  return {grid, danger::sampled<float>(
                    grid,
                    [](std::span<const double> s) {
                      return 5.0 - s[2] - std::hypot(s[0] - 1.0, s[1] + 2.0);
                    },
                    1)};
}

TEST(ValueMap, HoldsTheValueAtTheMiddles) {
  const ValueMap map = value_map(cone(), {-8.0, 8.0}, {-8.0, 4.0}, 32, 12, {0.0, 0.0, 1.5});
  ASSERT_EQ(map.values.size(), 32U * 12U);
  EXPECT_NEAR(map.middle(0, 0).x, -7.75, 1e-12);
  EXPECT_NEAR(map.middle(31, 11).y, 3.5, 1e-12);
  for (const auto& [column, row] : {std::pair{0, 0}, {31, 0}, {5, 11}, {20, 3}}) {
    const Vec2 at = map.middle(column, row);
    EXPECT_NEAR(static_cast<double>(map.values[map.index(column, row)]),
                3.5 - std::hypot(at.x - 1.0, at.y + 2.0), 0.01);  // the table's spacing is 1/8
  }
}

TEST(ValueMap, SaysWhatLiesOutside) {
  const ValueMap map = value_map(cone(), {-14.0, 10.0}, {-10.0, 10.0}, 12, 4, {});
  EXPECT_EQ(map.inside[map.index(1, 2)], 0);  // x = -11
  EXPECT_EQ(map.inside[map.index(2, 2)], 1);  // x = -9
}

/// V = minus the distance from the obstacle, on ahead and left or on x and y.
ValueTable distance_over(danger::View view) {
  const double pi = 3.14159265358979324;
  const bool ego = view == danger::View::ego;
  const Grid grid{{{.name = ego ? "ahead" : "x", .first = -12.0, .last = 12.0, .points = 97},
                   {.name = ego ? "left" : "y",
                    .first = 0.0,
                    .last = 12.0,
                    .points = 49,
                    .edge = danger::Edge::mirrored,
                    .turned = 2},
                   {.name = ego ? "turned" : "course",
                    .first = -pi,
                    .last = pi,
                    .points = 8,
                    .edge = danger::Edge::periodic},
                   {.name = "speed", .first = 0.0, .last = 20.0, .points = 4}}};
  return {grid, danger::sampled<float>(
                    grid, [](std::span<const double> s) { return -std::hypot(s[0], s[1]); }, 1)};
}

TEST(ValueMap, IsTheSameFromEitherView) {
  const ValueTable from_ego = distance_over(danger::View::ego);
  const ValueTable from_obstacle = distance_over(danger::View::obstacle);
  const danger::State others{0.0, 0.0, 0.6, 11.0};
  const ValueMap one = value_map(danger::in_obstacle_frame(from_ego, danger::View::ego),
                                 {-8.0, 8.0}, {-8.0, 8.0}, 40, 40, others);
  const ValueMap other = value_map(from_obstacle, {-8.0, 8.0}, {-8.0, 8.0}, 40, 40, others);
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    ASSERT_NEAR(one.values[i], other.values[i], 0.05) << i;  // the tables' spacing is 1/4
    ASSERT_EQ(one.inside[i], 1);
  }
}

TEST(Zoom, LeavesOutWhatLiesOutside) {
  ValueMap map = value_map(cone(), {-9.0, 9.0}, {-9.0, 9.0}, 20, 20, {});
  map.values.assign(400, -1.0F);
  map.values[0] = 1.0F;
  EXPECT_EQ(zoom_on_danger(map, {0.0, 0.0}), 1.0);
  map.inside[0] = 0;
  EXPECT_EQ(zoom_on_danger(map, {0.0, 0.0}), 8.0);
}

TEST(ValueMap, RefusesEmptyRanges) {
  EXPECT_THROW((void)value_map(cone(), {1.0, 1.0}, {0.0, 1.0}, 4, 4, {}), ContractViolation);
  EXPECT_THROW((void)value_map(cone(), {0.0, 1.0}, {0.0, 1.0}, 1, 4, {}), ContractViolation);
}

TEST(Zoom, KeepsAllDangerWithinItsShareOfTheRanges) {
  const MapRange x{-9.0, 9.0};
  const MapRange y{-9.0, 9.0};
  const ValueMap map = value_map(cone(), x, y, 180, 180, {0.0, 0.0, 2.0});
  // Unsafe: within 3 m of (1, -2), thus up to 5 m from the origin along -y.
  const double zoom = zoom_on_danger(map, zoom_middle(x, y));
  EXPECT_NEAR(zoom, 0.6 * 9.0 / 5.0, 0.03);
  const MapRange closer = zoomed(y, 0.0, zoom);
  EXPECT_NEAR(closer.low * 0.6, -5.0, 0.15);
  EXPECT_NEAR(closer.high, -closer.low, 1e-12);
}

TEST(Zoom, IsBoundedAndTurnsAboutTheOriginOrTheMiddle) {
  ValueMap map = value_map(cone(), {-9.0, 9.0}, {-9.0, 9.0}, 20, 20, {});
  map.values.assign(400, 1.0F);
  EXPECT_EQ(zoom_on_danger(map, {0.0, 0.0}), 1.0);
  map.values.assign(400, -1.0F);
  EXPECT_EQ(zoom_on_danger(map, {0.0, 0.0}), 8.0);
  EXPECT_EQ(zoom_middle({-1.0, 9.0}, {2.0, 6.0}).x, 0.0);
  EXPECT_EQ(zoom_middle({-1.0, 9.0}, {2.0, 6.0}).y, 4.0);
  EXPECT_DOUBLE_EQ(zoomed({2.0, 6.0}, 4.0, 2.0).low, 3.0);
  EXPECT_DOUBLE_EQ(zoomed({2.0, 6.0}, 4.0, 2.0).high, 5.0);
}

TEST(ZeroLine, OfAConeIsItsCircle) {
  const ValueMap map = value_map(cone(), {-9.0, 9.0}, {-9.0, 9.0}, 90, 90, {0.0, 0.0, 1.0});
  const auto line = zero_line(map);
  double length = 0.0;
  for (const auto& [a, b] : line) {
    EXPECT_NEAR(std::hypot(a.x - 1.0, a.y + 2.0), 4.0, 0.01);
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  EXPECT_NEAR(length, 2.0 * 3.14159265 * 4.0, 0.05);  // once around, without gaps
}

ValueMap two_by_two(float low_left, float low_right, float up_left, float up_right) {
  return {.x = {0.0, 2.0},
          .y = {0.0, 2.0},
          .columns = 2,
          .rows = 2,
          .values = {low_left, low_right, up_left, up_right},
          .inside = {1, 1, 1, 1}};
}

TEST(ZeroLine, JoinsAtASaddleWhatTheMiddleJoins) {
  // The middle is unsafe: the safe corners, lower right and upper left, are cut off.
  const auto line = zero_line(two_by_two(3.0F, -1.0F, -1.0F, 3.0F));
  ASSERT_EQ(line.size(), 2U);
  const auto cuts = [&](Vec2 corner) {
    int count = 0;
    for (const auto& [a, b] : line) {
      const Vec2 middle = 0.5 * (a + b);
      count += std::hypot(middle.x - corner.x, middle.y - corner.y) < 0.3 ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(cuts({1.5, 0.5}), 1);
  EXPECT_EQ(cuts({0.5, 1.5}), 1);
  EXPECT_EQ(zero_line(two_by_two(1.0F, -3.0F, -3.0F, 1.0F)).size(), 2U);
}

TEST(ZeroLine, IsEmptyWithoutAChangeOfSignAndOutside) {
  EXPECT_TRUE(zero_line(two_by_two(1.0F, 2.0F, 0.0F, 3.0F)).empty());
  ValueMap map = two_by_two(1.0F, -1.0F, 1.0F, -1.0F);
  EXPECT_EQ(zero_line(map).size(), 1U);
  map.inside[3] = 0;
  EXPECT_TRUE(zero_line(map).empty());
}

TEST(ValueScale, SpansTheValuesInRoundNumbers) {
  const ValueScale scale = scale_of({-37.0F, 1.3F, 0.5F});
  EXPECT_DOUBLE_EQ(scale.lowest, -50.0);
  EXPECT_DOUBLE_EQ(scale.highest, 2.0);
  EXPECT_GT(scale_of({-3.0F, -2.0F}).highest, 0.0);
  EXPECT_LT(scale_of({}).lowest, 0.0);
  EXPECT_DOUBLE_EQ(scale_of({0.05F}).highest, 0.05);
}

TEST(ValueScale, DangerIsWarmAndSafetyCool) {
  const ValueScale scale{.lowest = -20.0, .highest = 2.0};
  EXPECT_EQ(colour_of(0.0, scale), danger_colours.front());
  EXPECT_EQ(colour_of(5.0, scale), danger_colours.back());
  EXPECT_EQ(colour_of(-99.0, scale), safety_colours.back());
  EXPECT_EQ(colour_of(-8.0, scale), safety_colours[2]);  // two fifths of the way
  EXPECT_GT(colour_of(1.0, scale).red, colour_of(1.0, scale).blue);
  EXPECT_LT(colour_of(-1.0, scale).red, colour_of(-1.0, scale).blue);
}

TEST(ObstacleOutline, IsWhatTheCaseSays) {
  const auto box = obstacle_outline("[obstacle]\nshape = \"box\"\nlength_m = 4.7\nwidth_m = 1.9\n");
  ASSERT_EQ(box.size(), 4U);
  EXPECT_DOUBLE_EQ(std::abs(box[0].x), 2.35);
  EXPECT_DOUBLE_EQ(std::abs(box[0].y), 0.95);
  for (const Vec2 p :
       obstacle_outline("[obstacle]\nshape = \"ellipse\"\nlength_m = 7.0\nwidth_m = 3.5")) {
    EXPECT_NEAR(p.x * p.x / (3.5 * 3.5) + p.y * p.y / (1.75 * 1.75), 1.0, 1e-12);
  }
  const auto wall = obstacle_outline("[obstacle]\nshape = \"segment\"\nlength_m = 6.0");
  ASSERT_EQ(wall.size(), 2U);
  EXPECT_EQ(norm(wall[1] - wall[0]), 6.0);
}

TEST(ObstacleOutline, IsEmptyWhereThereIsNone) {
  for (const char* const problem : {"", "no TOML [", "obstacle = 3", "[obstacle]\nshape = \"edge\"",
                                    "[obstacle]\nshape = \"blob\"\nlength_m = 1\nwidth_m = 1",
                                    "[obstacle]\nshape = \"box\"\nlength_m = -1\nwidth_m = 1",
                                    "[obstacle]\nshape = 1\nlength_m = 1\nwidth_m = 1"}) {
    EXPECT_TRUE(obstacle_outline(problem).empty()) << problem;
  }
}

TEST(ProblemName, IsTheCasesOwn) {
  EXPECT_EQ(problem_name("name = \"truck\""), "truck");
  EXPECT_EQ(problem_name(""), std::nullopt);
  EXPECT_EQ(problem_name("name = 3 ="), std::nullopt);
}

}  // namespace
}  // namespace saca::report::value_map_test
