#include "saca/lab/report/road_svg.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/report/xml_for_test.h"

namespace saca::report::road_svg_test {
namespace {

using world::Beyond;
using world::Road;

/// 10 px a metre; 20 m ahead and behind, 10 m to either side.
const PictureFrame frame_400x200{{}, {{-20.0, -10.0}, {20.0, 10.0}}, 10.0};

Road two_lanes() {
  return {.lane_width = 3.5, .left_edge = 5.25, .right_edge = -1.75};
}

std::vector<XmlElement> drawn(const Road& road) {
  return xml_elements("<g>" + road_svg(road, frame_400x200) + "</g>");
}

TEST(RoadSvg, EdgesLieWhereTheRoadEnds) {
  const auto road = with_class(drawn(two_lanes()), "polygon", "road");
  ASSERT_EQ(road.size(), 1U);
  for (const Vec2 p : xml_points(road[0])) {
    // y downwards, d = 0 in the middle at 100 px
    EXPECT_TRUE(p.y == 100.0 - 52.5 || p.y == 100.0 + 17.5) << p.y;
    EXPECT_TRUE(p.x < 0.0 || p.x > 400.0) << "it runs through the whole picture";
  }
}

TEST(RoadSvg, MarksLanesAndOncomingTraffic) {
  EXPECT_EQ(with_class(drawn(two_lanes()), "polyline", "mark dashed").size(), 1U);
  EXPECT_EQ(with_class(drawn(two_lanes()), "polyline", "mark").size(), 2U);  // the outer ones
  Road oncoming = two_lanes();
  oncoming.oncoming_left = true;
  const auto double_line = with_class(drawn(oncoming), "polyline", "mark");
  EXPECT_EQ(double_line.size(), 4U);
  EXPECT_TRUE(with_class(drawn(oncoming), "polyline", "mark dashed").empty());
}

TEST(RoadSvg, ShowsWhatStandsBeyond) {
  Road road = two_lanes();
  road.left_beyond = Beyond::trees;
  road.right_beyond = Beyond::kerb;
  auto all = drawn(road);
  EXPECT_GE(with_class(all, "circle", "tree").size(), 6U);
  for (const XmlElement& tree : with_class(all, "circle", "tree")) {
    EXPECT_LT(xml_number(tree, "cy"), 100.0 - 52.5) << "beyond the left edge";
  }
  EXPECT_EQ(with_class(all, "polygon", "kerb-hatch").size(), 1U);
  EXPECT_TRUE(with_class(all, "polyline", "barrier").empty());
  road.right_beyond = Beyond::barrier;
  all = drawn(road);
  ASSERT_EQ(with_class(all, "polyline", "barrier").size(), 1U);
  EXPECT_GE(with_class(all, "rect", "post").size(), 9U);  // 40 m, one every 4 m
}

TEST(RoadSvg, BendsAreArcs) {
  Road road = two_lanes();
  road.curvature = 0.02;  // centre 50 m to the left: (200, 100 - 500) px
  for (const Vec2 p : xml_points(with_class(drawn(road), "polygon", "road")[0])) {
    const double r = norm(p - Vec2{200.0, -400.0});
    EXPECT_TRUE(std::abs(r - 447.5) < 0.01 || std::abs(r - 517.5) < 0.01) << r;
  }
}

TEST(RoadSvg, IsMirrorSymmetric) {
  Road road = two_lanes();
  road.curvature = 0.013;
  road.left_beyond = Beyond::trees;
  road.right_beyond = Beyond::barrier;
  Road mirrored = road;
  mirrored.curvature = -road.curvature;
  std::swap(mirrored.left_beyond, mirrored.right_beyond);
  mirrored.left_edge = -road.right_edge;
  mirrored.right_edge = -road.left_edge;
  const auto trees = with_class(drawn(road), "circle", "tree");
  const auto others = with_class(drawn(mirrored), "circle", "tree");
  ASSERT_EQ(trees.size(), others.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    EXPECT_NEAR(xml_number(trees[i], "cx"), xml_number(others[i], "cx"), 0.011);
    EXPECT_NEAR(xml_number(trees[i], "cy"), 200.0 - xml_number(others[i], "cy"), 0.011);
  }
}

TEST(RoadSvg, AnInnerEdgeBeyondTheBendsCentreIsDrawnInFiniteNumbers) {
  Road road = two_lanes();
  road.curvature = 0.3;  // centre at 3.3 m, edge at 5.25 m
  EXPECT_FALSE(with_class(drawn(road), "polygon", "road").empty());
}

}  // namespace
}  // namespace saca::report::road_svg_test
