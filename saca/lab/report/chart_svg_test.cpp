#include "saca/lab/report/chart_svg.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::chart_svg_test {
namespace {

ChartSheet two_charts() {
  ChartLine line{.name = "one & only",
                 .note = "Author 2001",
                 .colour = ChartColour::green,
                 .points = {{0.0, 0.0}, {5.0, 0.25}, {10.0, 1.0}},
                 .low = {0.0, 0.2, 0.9},
                 .high = {0.1, 0.3, 1.0}};
  ChartLine plain{.name = "dashed", .dashed = true, .points = {{0.0, 1.0}, {10.0, 0.0}}};
  const PlotAxis x{"speed", "m/s", 0.0, 10.0};
  const PlotAxis y{"probability", "", 0.0, 1.0};
  return {"Charts", {"below"}, {{"left", x, y, {line, plain}}, {"right", x, y, {plain}}}};
}

TEST(ChartSvg, CurvesRunThroughTheirPoints) {
  const auto all = xml_elements(chart_svg(two_charts()));
  const auto curves = with_class(all, "polyline", "curve stroke-green");
  ASSERT_EQ(curves.size(), 1U);
  const auto points = xml_points(curves[0]);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[1].x, 0.5 * (points[0].x + points[2].x), 0.01);
  EXPECT_NEAR(points[0].y - points[1].y, 0.25 * (points[0].y - points[2].y), 0.02);
  const auto band = with_class(all, "polygon", "band fill-green");
  ASSERT_EQ(band.size(), 1U);
  EXPECT_EQ(xml_points(band[0]).size(), 6U);
  for (const char* words :
       {"Charts", "below", "left", "right", "one & only", "Author 2001", "speed [m/s]"}) {
    EXPECT_TRUE(says(all, words)) << words;
  }
}

TEST(ChartSvg, ChartsStandBesideEachOther) {
  const auto all = xml_elements(chart_svg(two_charts()));
  const auto dashed = with_class(all, "polyline", "curve stroke-blue dash");
  ASSERT_EQ(dashed.size(), 2U);
  EXPECT_GT(xml_points(dashed[1])[0].x, xml_points(dashed[0])[1].x);
  EXPECT_EQ(xml_points(dashed[1])[0].y, xml_points(dashed[0])[0].y);
  EXPECT_LT(xml_points(dashed[1])[1].x, xml_number(all[0], "width"));
}

TEST(ChartSvg, RefusesWhatDoesNotBelongTogether) {
  EXPECT_THROW((void)chart_svg({}), ContractViolation);
  ChartSheet sheet = two_charts();
  sheet.charts[0].curves[0].low.pop_back();
  EXPECT_THROW((void)chart_svg(sheet), ContractViolation);
  sheet = two_charts();
  sheet.charts[0].x.high = 0.0;
  EXPECT_THROW((void)chart_svg(sheet), ContractViolation);
}

DotChart dots() {
  return {"Expected harm",
          {},
          "harm",
          "",
          {{"AEB", "p0", "best", 0.1, 0.05, 0.15},
           {"T-D-L", "p5", "refused: too slow", std::nullopt, 0.0, 0.0},
           {"NI", "p7", "", 0.4, 0.3, 0.6}}};
}

TEST(DotsSvg, DotsLieInProportionBetweenTheirWhiskers) {
  const auto all = xml_elements(dots_svg(dots()));
  const auto aeb = with_class(all, "circle", "dot p0");
  const auto none = with_class(all, "circle", "dot p7");
  ASSERT_EQ(aeb.size(), 1U);
  ASSERT_EQ(none.size(), 1U);
  EXPECT_TRUE(with_class(all, "circle", "dot p5").empty());
  // px = zero + harm * scale, so from two dots both are known.
  const double scale = (xml_number(none[0], "cx") - xml_number(aeb[0], "cx")) / (0.4 - 0.1);
  const double zero = xml_number(aeb[0], "cx") - 0.1 * scale;
  bool found = false;
  for (const XmlElement& line : with_class(all, "line", "axis")) {
    if (xml_number(line, "y1") == xml_number(none[0], "cy") &&
        xml_number(line, "y1") == xml_number(line, "y2")) {
      EXPECT_NEAR(xml_number(line, "x1"), zero + 0.3 * scale, 0.05);
      EXPECT_NEAR(xml_number(line, "x2"), zero + 0.6 * scale, 0.05);
      found = true;
    }
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(says(all, "refused: too slow"));
}

TEST(DotsSvg, RefusesValuesOutsideTheirIntervals) {
  DotChart chart = dots();
  chart.rows[0].low = 0.2;
  EXPECT_THROW((void)dots_svg(chart), ContractViolation);
  chart.rows.clear();
  EXPECT_THROW((void)dots_svg(chart), ContractViolation);
}

TEST(DotsSvg, HarmlessScenesHaveAnAxisToo) {
  DotChart chart = dots();
  chart.rows = {{"NI", "p7", "", 0.0, 0.0, 0.0}};
  EXPECT_EQ(with_class(xml_elements(dots_svg(chart)), "circle", "dot p7").size(), 1U);
}

}  // namespace
}  // namespace saca::report::chart_svg_test
