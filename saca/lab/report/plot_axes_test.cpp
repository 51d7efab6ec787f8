#include "saca/lab/report/plot_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/report/xml_for_test.h"

namespace saca::report::plot_axes_test {
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

// A line across the whole plot for each tick: the ticks' numbers are the independent count.
TEST(PlotAxes, TheGridEndsWithThePlot) {
  const PlotArea area = example_area();
  const auto ticks = [](const std::string& axis) {
    return with_class(xml_elements("<g>" + axis + "</g>"), "text", "soft");
  };
  const auto grid = with_class(xml_elements("<g>" + plot_grid(area) + "</g>"), "line", "grid");
  std::vector<double> across;  // [px]
  std::vector<double> up;
  for (const XmlElement& line : grid) {
    if (xml_number(line, "x1") == xml_number(line, "x2")) {
      EXPECT_EQ(xml_number(line, "y1"), 20.0);
      EXPECT_EQ(xml_number(line, "y2"), 220.0);
      up.push_back(xml_number(line, "x1"));
    } else {
      EXPECT_EQ(xml_number(line, "x1"), 50.0);
      EXPECT_EQ(xml_number(line, "x2"), 450.0);
      EXPECT_EQ(xml_number(line, "y1"), xml_number(line, "y2"));
      across.push_back(xml_number(line, "y1"));
    }
  }
  std::vector<double> x_ticks;
  for (const XmlElement& number : ticks(plot_x_axis(area))) {
    x_ticks.push_back(area.x_px(std::stod(number.text)));
  }
  std::vector<double> y_ticks;
  for (const XmlElement& number : ticks(plot_y_axis(area))) {
    y_ticks.push_back(area.y_px(std::stod(number.text)));
  }
  EXPECT_GE(up.size(), 4U);
  EXPECT_GE(across.size(), 4U);
  EXPECT_THAT(up, testing::Pointwise(testing::DoubleNear(0.01), x_ticks));
  EXPECT_THAT(across, testing::Pointwise(testing::DoubleNear(0.01), y_ticks));
}

}  // namespace
}  // namespace saca::report::plot_axes_test
