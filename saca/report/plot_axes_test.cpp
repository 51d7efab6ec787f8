#include "saca/report/plot_axes.h"

#include <gtest/gtest.h>

#include "saca/report/xml_for_test.h"

namespace saca::report {
namespace {

PlotArea example_area() {
  return {{50.0, 20.0}, {400.0, 200.0}, {"speed", "m/s", 0.0, 10.0}, {"harm", "", 0.0, 1.0}};
}

TEST(PlotAxes, ValuesLieInProportionAndYGoesUp) {
  const PlotArea area = example_area();
  EXPECT_EQ(area.x_px(0.0), 50.0);
  EXPECT_EQ(area.x_px(2.5), 150.0);
  EXPECT_EQ(area.y_px(1.0), 20.0);
  EXPECT_EQ(area.y_px(0.25), 170.0);
}

TEST(PlotAxes, TicksStandAtTheirNumbers) {
  const PlotArea area = example_area();
  const auto all = xml_elements("<g>" + plot_x_axis(area) + plot_y_axis(area) + "</g>");
  EXPECT_TRUE(says(all, "speed [m/s]"));
  EXPECT_TRUE(says(all, "harm"));
  int numbers = 0;
  for (const XmlElement& element : with_class(all, "text", "soft")) {
    const double value = std::stod(element.text);
    const bool below = element.attributes.at("text-anchor") == "middle";
    const double at = below ? xml_number(element, "x") : xml_number(element, "y") - 4.0;
    EXPECT_NEAR(at, below ? area.x_px(value) : area.y_px(value), 0.01) << element.text;
    ++numbers;
  }
  EXPECT_GE(numbers, 8);
}

TEST(PlotAxes, TheGridEndsWithThePlot) {
  for (const XmlElement& line :
       with_class(xml_elements("<g>" + plot_grid(example_area()) + "</g>"), "line", "grid")) {
    EXPECT_GE(xml_number(line, "x1"), 50.0);
    EXPECT_LE(xml_number(line, "x2"), 450.0);
    EXPECT_GE(xml_number(line, "y1"), 20.0);
    EXPECT_LE(xml_number(line, "y2"), 220.0);
  }
}

}  // namespace
}  // namespace saca::report
