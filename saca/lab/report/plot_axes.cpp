#include "saca/lab/report/plot_axes.h"

#include <fmt/format.h>

#include <cmath>

namespace saca::report {
namespace {

constexpr int most_x_ticks = 9;
constexpr int most_y_ticks = 7;
constexpr double tick = 4.0;  // [px]

/// Without rounding noise: 0.30000000000000004 is 0.3.
std::string tick_text(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

}  // namespace

std::string axis_words(const PlotAxis& axis) {
  return axis.unit.empty() ? axis.name : fmt::format("{} [{}]", axis.name, axis.unit);
}

std::string plot_grid(const PlotArea& area) {
  std::string out;
  const double right = area.at.x + area.size.width;
  const double bottom = area.at.y + area.size.height;
  for (const double value : round_ticks(area.x.low, area.x.high, most_x_ticks)) {
    out += svg_line("grid", {area.x_px(value), area.at.y}, {area.x_px(value), bottom});
  }
  for (const double value : round_ticks(area.y.low, area.y.high, most_y_ticks)) {
    out += svg_line("grid", {area.at.x, area.y_px(value)}, {right, area.y_px(value)});
  }
  return out;
}

std::string plot_x_axis(const PlotArea& area) {
  const double bottom = area.at.y + area.size.height;
  std::string out = svg_line("axis", {area.at.x, bottom}, {area.at.x + area.size.width, bottom});
  for (const double value : round_ticks(area.x.low, area.x.high, most_x_ticks)) {
    const double x = area.x_px(value);
    out += svg_line("axis", {x, bottom}, {x, bottom + tick});
    out += svg_text("soft", {x, bottom + 16.0}, tick_text(value), Anchor::middle);
  }
  return out + svg_text("strong", {area.at.x + area.size.width / 2.0, bottom + 33.0},
                        axis_words(area.x), Anchor::middle);
}

std::string plot_y_axis(const PlotArea& area) {
  std::string out = svg_line("axis", area.at, {area.at.x, area.at.y + area.size.height});
  for (const double value : round_ticks(area.y.low, area.y.high, most_y_ticks)) {
    const double y = area.y_px(value);
    out += svg_line("axis", {area.at.x - tick, y}, {area.at.x, y});
    out += svg_text("soft", {area.at.x - 7.0, y + 4.0}, tick_text(value), Anchor::end);
  }
  const Vec2 middle{area.at.x - 46.0, area.at.y + area.size.height / 2.0};
  return out + fmt::format(
                   "<text class=\"strong\" text-anchor=\"middle\" "
                   "transform=\"translate({} {}) rotate(-90)\">{}</text>\n",
                   svg_number(middle.x), svg_number(middle.y), escaped(axis_words(area.y)));
}

}  // namespace saca::report
