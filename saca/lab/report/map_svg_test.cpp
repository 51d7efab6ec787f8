#include "saca/lab/report/map_svg.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::map_svg_test {
namespace {

using manoeuvre::PolicyId;

/// 4 x 3 cells: AEB in the lower rows, ES-B-R in the upper one but for its last cell.
PolicyMap example() {
  PolicyMap map;
  map.title = "truck & speed";
  map.x = {"truck.distance", "m", {10.0, 12.0, 14.0, 16.0}, 12.0};
  map.y = {"ego.speed", "m/s", {8.0, 9.0, 10.0}, 9.0};
  map.cells.assign(12, {MapVerdict::decided, PolicyId::aeb, 0.5});
  for (std::size_t column = 0; column < 3; ++column) {
    map.cells[8 + column] = {MapVerdict::decided, PolicyId::es_b_right, 0.05};
  }
  map.cells[11].verdict = MapVerdict::no_risk;
  return map;
}

double area_of(const std::vector<XmlElement>& rects) {
  return std::accumulate(rects.begin(), rects.end(), 0.0, [](double sum, const XmlElement& rect) {
    return sum + xml_number(rect, "width") * xml_number(rect, "height");
  });
}

TEST(MapSvg, AreasAreInProportionToTheirCells) {
  const auto all = xml_elements(map_svg(example()));
  const auto frame = with_class(all, "rect", "frame");
  double whole = 0.0;
  for (const XmlElement& one : frame) {
    whole = std::max(whole, xml_number(one, "width") * xml_number(one, "height"));
  }
  const auto swatch = 18.0 * 12.0;  // in the legend
  EXPECT_NEAR(area_of(with_class(all, "rect", "p0 m4")) / whole, 8.0 / 12.0, 1e-3);
  EXPECT_NEAR(area_of(with_class(all, "rect", "p4 m3")) / whole, 3.0 / 12.0, 1e-3);
  EXPECT_NEAR((area_of(with_class(all, "rect", "no-risk")) - swatch) / whole, 1.0 / 12.0, 1e-3);
  EXPECT_NEAR((area_of(with_class(all, "rect", "right")) - swatch) / whole, 3.0 / 12.0, 1e-3)
      << "stripes lie over policies to the right, and nothing else";
}

TEST(MapSvg, YGoesUpAndXToTheRight) {
  const auto all = xml_elements(map_svg(example()));
  const auto upper = with_class(all, "rect", "p4 m3");
  const auto lower = with_class(all, "rect", "p0 m4");
  ASSERT_EQ(upper.size(), 1U) << "cells that look alike in a row are one block";
  ASSERT_EQ(lower.size(), 2U);
  EXPECT_LT(xml_number(upper[0], "y"), xml_number(lower[0], "y"));
  EXPECT_EQ(xml_number(upper[0], "x"), xml_number(lower[0], "x"));
  EXPECT_LT(xml_number(upper[0], "width"), xml_number(lower[0], "width"));
}

TEST(MapSvg, TheMarkLiesWhereTheScenarioIs) {
  const PolicyMap map = example();
  const auto all = xml_elements(map_svg(map));
  const auto marks = with_class(all, "circle", "nominal");
  ASSERT_EQ(marks.size(), 2U) << "in the map and in the legend";
  const auto lower = with_class(all, "rect", "p0 m4");
  // The lower block spans x 9 to 17 m; its rows, from the bottom, y 7.5 to 8.5 and to 9.5 m/s.
  const double left = xml_number(lower[0], "x");
  const double width = xml_number(lower[0], "width");
  EXPECT_NEAR(xml_number(marks[0], "cx"), left + width * (12.0 - 9.0) / 8.0, 0.02);
  EXPECT_NEAR(xml_number(marks[0], "cy"),
              xml_number(lower[1], "y") + 0.5 * xml_number(lower[1], "height"), 0.02);
  PolicyMap without = map;
  without.x.nominal.reset();
  EXPECT_TRUE(with_class(xml_elements(map_svg(without)), "circle", "nominal").empty());
}

TEST(MapSvg, SaysWhatItShows) {
  const auto all = xml_elements(map_svg(example()));
  for (const char* words :
       {"truck & speed", "truck.distance [m]", "ego.speed [m/s]", "0 AEB", "8  (66.7 %)",
        "4 ES-B-R", "3  (25.0 %)", "1  (8.3 %)", "AEB", "ES-B-R", "no risk"}) {
    EXPECT_TRUE(says(all, words)) << words;
  }
  EXPECT_FALSE(says(all, "5 T-D-L"));
  EXPECT_FALSE(says(all, "no such scene"));
}

TEST(MapSvg, ColoursArePalerWhereLessIsAtStake) {
  PolicyMap map = example();
  const std::array margins{0.0, 0.0009, 0.001, 0.0099, 0.01, 0.0999, 0.1, 3.0};
  map.x.values = {1, 2, 3, 4, 5, 6, 7, 8};
  map.y.values = {1};
  map.cells.clear();
  for (const double margin : margins) {
    map.cells.push_back({MapVerdict::decided, PolicyId::aeb, margin});
  }
  const auto all = xml_elements(map_svg(map));
  for (const char* looks : {"p0 m1", "p0 m2", "p0 m3", "p0 m4"}) {
    const auto blocks = with_class(all, "rect", looks);
    ASSERT_EQ(blocks.size(), 1U) << looks;
    EXPECT_NEAR(xml_number(blocks[0], "width"), 140.0, 0.02);  // two cells of eight in 560 px
  }
}

TEST(MapSvg, EachConnectedAreaHasItsNameOnce) {
  PolicyMap map = example();
  map.x.values.clear();
  map.cells.clear();
  for (int k = 0; k < 21; ++k) {
    map.x.values.push_back(k);
  }
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 21; ++k) {  // AEB, AES-L, AEB
      const PolicyId best = k / 7 == 1 ? PolicyId::aes_left : PolicyId::aeb;
      map.cells.push_back({MapVerdict::decided, best, 0.2 * (k % 2)});
    }
  }
  const auto names = with_class(xml_elements(map_svg(map)), "text", "halo strong");
  ASSERT_EQ(names.size(), 3U);
  EXPECT_EQ(names[0].text, "AEB");
  EXPECT_EQ(names[1].text, "AES-L");
  EXPECT_EQ(names[2].text, "AEB");
  EXPECT_LT(xml_number(names[0], "x"), xml_number(names[1], "x"));
}

TEST(MapSvg, RefusesWhatDoesNotBelongTogether) {
  PolicyMap map = example();
  map.cells.pop_back();
  EXPECT_THROW((void)map_svg(map), ContractViolation);
  map = example();
  map.x.values[1] = 10.0;
  EXPECT_THROW((void)map_svg(map), ContractViolation);
  map = example();
  map.cells[0].margin = -1.0;
  EXPECT_THROW((void)map_svg(map), ContractViolation);
}

// The drifts cannot be driven in the two left columns: 6 of 12 cells each, 1 of them empty.
TEST(MapSvg, RefusedPoliciesAreDrawnAndCounted) {
  PolicyMap map = example();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 2; ++column) {
      map.cells[4 * row + column].refused[manoeuvre::index(PolicyId::t_drift_left)] = true;
    }
  }
  map.cells[0].refused[manoeuvre::index(PolicyId::t_drift_right)] = true;
  map.cells[4].verdict = MapVerdict::unplayable;  // where nothing can be said of it
  const auto all = xml_elements(map_svg(map));
  double whole = 0.0;
  for (const XmlElement& one : with_class(all, "rect", "frame")) {
    whole = std::max(whole, xml_number(one, "width") * xml_number(one, "height"));
  }
  const double swatches = 2.0 * 18.0 * 12.0;
  EXPECT_NEAR((area_of(with_class(all, "rect", "refused")) - swatches) / whole, 5.0 / 12.0, 1e-3);
  EXPECT_TRUE(says(all, "refused from there, cells"));
  EXPECT_TRUE(says(all, "5 T-D-L"));
  EXPECT_TRUE(says(all, "5  (41.7 %)"));
  EXPECT_TRUE(says(all, "6 T-D-R"));
  EXPECT_FALSE(says(xml_elements(map_svg(example())), "refused from there, cells"));
}

// Cells reach half a step beyond the outermost values: x from 9 to 17 m, y from 7.5 to 10.5 m/s.
TEST(MapSvg, TheMarkIsLeftOutWhereTheScenarioIsOutside) {
  const auto num_marks = [](double x, double y) {
    PolicyMap map = example();
    map.x.nominal = x;
    map.y.nominal = y;
    return with_class(xml_elements(map_svg(map)), "circle", "nominal").size();
  };
  EXPECT_EQ(num_marks(9.1, 10.4), 2U);
  EXPECT_EQ(num_marks(8.9, 9.0), 0U);
  EXPECT_EQ(num_marks(17.1, 9.0), 0U);
  EXPECT_EQ(num_marks(12.0, 7.4), 0U);
  EXPECT_EQ(num_marks(12.0, 10.6), 0U);
}

PolicyStrip strip() {
  PolicyStrip one;
  one.title = "one parameter";
  one.x = {"speed", "m/s", {10.0, 11.0, 12.0, 13.0}, std::nullopt};
  one.cells.assign(4, {MapVerdict::decided, PolicyId::aeb, 0.5});
  one.curves = {{PolicyId::aeb, {0.0, 0.1, 0.2, 0.4}, {0.0, 0.0, 0.1, 0.3}, {0.1, 0.2, 0.3, 0.5}},
                {PolicyId::t_drift_right, {0.3, std::nullopt, 0.2, 0.1}, {}, {}}};
  return one;
}

TEST(StripSvg, CurvesAreInProportionAndBreakWhereRefused) {
  const auto all = xml_elements(strip_svg(strip()));
  const auto aeb = with_class(all, "polyline", "curve l0");
  ASSERT_EQ(aeb.size(), 1U);
  const auto points = xml_points(aeb[0]);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[0].y - points[3].y, 4.0 * (points[0].y - points[1].y), 0.05);
  EXPECT_NEAR(points[3].x - points[0].x, 3.0 * (points[1].x - points[0].x), 0.05);
  EXPECT_EQ(with_class(all, "polygon", "band p0").size(), 1U);
  EXPECT_EQ(with_class(all, "polyline", "curve l6").size(), 1U);
  EXPECT_EQ(with_class(all, "circle", "dot p6").size(), 1U) << "one value alone is a dot";
}

TEST(StripSvg, ARefusedPolicyHasABarWhereItIsRefused) {
  PolicyStrip one = strip();
  one.cells[1].refused[manoeuvre::index(PolicyId::t_drift_right)] = true;
  one.x.nominal = 20.0;  // outside 9.5 to 13.5
  const auto all = xml_elements(strip_svg(one));
  const auto bars = with_class(all, "rect", "refused");
  ASSERT_EQ(bars.size(), 2U) << "in its row and in the legend";
  EXPECT_NEAR(xml_number(bars[0], "width"), 140.0, 0.02);  // one cell of four in 560 px
  EXPECT_TRUE(says(all, "6 T-D-R"));
  EXPECT_FALSE(says(all, "the scenario as it is"));
}

TEST(StripSvg, RefusesWhatDoesNotBelongTogether) {
  PolicyStrip one = strip();
  one.curves[0].harm.pop_back();
  EXPECT_THROW((void)strip_svg(one), ContractViolation);
  one = strip();
  one.curves[0].low.pop_back();
  EXPECT_THROW((void)strip_svg(one), ContractViolation);
  one = strip();
  one.cells.pop_back();
  EXPECT_THROW((void)strip_svg(one), ContractViolation);
}

}  // namespace
}  // namespace saca::report::map_svg_test
