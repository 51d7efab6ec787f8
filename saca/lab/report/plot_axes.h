#pragma once

#include <string>

#include "saca/lab/report/svg.h"

namespace saca::report {

/// What an axis counts.
struct PlotAxis {
  std::string name;
  std::string unit;  ///< empty: none
  double low = 0.0;  ///< < high
  double high = 1.0;
};

/// A plot's place in a picture, and its two axes.
struct PlotArea {
  Vec2 at;  ///< upper left corner [px]
  SvgSize size;
  PlotAxis x;
  PlotAxis y;  ///< upwards

  [[nodiscard]] double x_px(double x_value) const {
    return at.x + size.width * (x_value - x.low) / (x.high - x.low);
  }
  [[nodiscard]] double y_px(double y_value) const {
    return at.y + size.height * (y.high - y_value) / (y.high - y.low);
  }
  [[nodiscard]] Vec2 px(double x_value, double y_value) const {
    return {x_px(x_value), y_px(y_value)};
  }
};

/// Room that ticks and names take to the left of a plot and below it [px].
constexpr double axis_room_left = 62.0;
constexpr double axis_room_below = 42.0;

/// Lines across the plot at its ticks: drawn first.
[[nodiscard]] std::string plot_grid(const PlotArea& area);

/// Horizontal axis with ticks, numbers, name and unit.
[[nodiscard]] std::string plot_x_axis(const PlotArea& area);
[[nodiscard]] std::string plot_y_axis(const PlotArea& area);

/// "name [unit]"
[[nodiscard]] std::string axis_words(const PlotAxis& axis);

}  // namespace saca::report
