#include "saca/lab/report/fan_svg.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saca/lab/report/xml_for_test.h"

namespace saca::report::fan_svg_test {
namespace {

/// 10 m/s along `yaw` from the origin for 2.5 s; half of it lies within 1.1774 standard deviations.
LikelyWay way(double probability, double yaw) {
  LikelyWay one{.probability = probability,
                .track = {.start = 7.0, .step = 0.05, .X_WA = {}},
                .spread = {.start = 7.0, .step = 2.5, .at = {{0.0, 0.0}, {2.5, 0.5}}}};
  for (int k = 0; k <= 50; ++k) {
    one.track.X_WA.push_back({rotated({10.0 * 0.05 * k, 0.0}, yaw), yaw});
  }
  return one;
}

/// 4 px a metre; the origin lies 100 px right of the upper left corner and 200 px below it.
constexpr PictureFrame frame{.X_PW = {}, .seen_P = {{-25.0, -50.0}, {75.0, 50.0}}, .scale = 4.0};

std::vector<XmlElement> drawn(const std::vector<LikelyWay>& ways) {
  return xml_elements("<svg>" + fan_svg(ways, frame) + "</svg>");
}

TEST(FanSvg, AWayIsALineWithAnEllipseEachSecond) {
  const auto all = drawn({way(1.0, 0.0)});
  const auto lines = with_class(all, "polyline", "fan");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(xml_points(lines[0]).back().x, 100.0 + 4.0 * 25.0, 0.01);
  EXPECT_NEAR(xml_points(lines[0]).back().y, 200.0, 0.01);
  const auto places = with_class(all, "ellipse", "fan-place");
  ASSERT_EQ(places.size(), 2U);  // after 1 and 2 s
  EXPECT_NEAR(xml_number(places[1], "cx"), 100.0 + 4.0 * 20.0, 0.01);
  EXPECT_NEAR(xml_number(places[1], "rx"), 4.0 * 1.1774 * 2.0, 0.02);
  EXPECT_NEAR(xml_number(places[1], "ry"), 4.0 * 1.1774 * 0.4, 0.02);
}

TEST(FanSvg, TheLikelierIsThickerAndTheUnlikelyIsLeftOut) {
  const auto lines =
      with_class(drawn({way(0.7, 0.0), way(0.295, 0.2), way(0.005, 0.4)}), "polyline", "fan");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_GT(xml_number(lines[0], "stroke-width"), xml_number(lines[1], "stroke-width"));
  EXPECT_GT(xml_number(lines[0], "opacity"), xml_number(lines[1], "opacity"));
}

// Upwards in the world is upwards in the picture, where y points down.
TEST(FanSvg, EllipsesLieAlongTheWay) {
  const auto places = with_class(drawn({way(1.0, 0.5 * std::numbers::pi)}), "ellipse", "fan-place");
  ASSERT_EQ(places.size(), 2U);
  EXPECT_NEAR(xml_number(places[0], "cx"), 100.0, 0.01);
  EXPECT_NEAR(xml_number(places[0], "cy"), 200.0 - 4.0 * 10.0, 0.01);
  EXPECT_EQ(places[0].attributes.at("transform"), "rotate(-90 100 160)");
}

TEST(FanSvg, OfNobodyIsNothing) {
  EXPECT_EQ(fan_svg({}, frame), "");
}

}  // namespace
}  // namespace saca::report::fan_svg_test
