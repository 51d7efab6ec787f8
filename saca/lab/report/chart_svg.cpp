#include "saca/lab/report/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "saca/base/core/contract.h"

namespace saca::report {
namespace {

constexpr double chart_border = 16.0;  // [px]
constexpr double chart_gap = 18.0;     // between charts [px]
constexpr SvgSize curve_area{350.0, 240.0};
constexpr double chart_width = axis_room_left + curve_area.width;
constexpr double key_height = 32.0;  // of a legend's entry: name and note [px]
constexpr double dot_row = 24.0;     // [px]

constexpr std::array<std::string_view, 6> colour_names{"blue",   "orange", "green",
                                                       "purple", "grey",   "ink"};

std::string_view name_of_colour(ChartColour colour) {
  return colour_names.at(static_cast<std::size_t>(colour));
}

std::string chart_head(std::string_view heading, const std::vector<std::string>& lines,
                       double width, double& y) {
  y = chart_border + 16.0;
  std::string out = svg_text("heading", {chart_border, y},
                             fitted(heading, heading_font, width - 2 * chart_border));
  for (const std::string& line : lines) {
    y += 16.0;
    out += svg_text("soft", {chart_border, y}, fitted(line, usual_font, width - 2 * chart_border));
  }
  return out;
}

std::string carded(SvgSize size, std::string_view title, const std::string& body) {
  return svg_document(size, title,
                      svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}) + body);
}

std::string stroke_of(const ChartLine& line) {
  return fmt::format("curve stroke-{}{}", name_of_colour(line.colour), line.dashed ? " dash" : "");
}

std::string interval_band(const PlotArea& area, const ChartLine& line) {
  expects(line.low.size() == line.high.size(), "an interval has two ends");
  if (line.low.empty()) {
    return "";
  }
  expects(line.low.size() == line.points.size(), "an interval for each point");
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    outline.push_back(area.px(line.points[i].x, line.high[i]));
  }
  for (std::size_t i = line.points.size(); i-- > 0;) {
    outline.push_back(area.px(line.points[i].x, line.low[i]));
  }
  return svg_polygon(fmt::format("band fill-{}", name_of_colour(line.colour)), outline);
}

std::string line_of(const PlotArea& area, const ChartLine& line) {
  std::vector<Vec2> points;
  for (const Vec2 p : line.points) {
    points.push_back(area.px(p.x, p.y));
  }
  return svg_polyline(stroke_of(line), points);
}

/// Sample, name and note of each curve, downwards.
std::string keys(const std::vector<ChartLine>& curves, Vec2 at) {
  constexpr double sample = 26.0;
  std::string out;
  for (const ChartLine& line : curves) {
    out += svg_line(stroke_of(line), at, at + Vec2{sample, 0.0});
    out += svg_text("strong", at + Vec2{sample + 8.0, 4.0},
                    fitted(line.name, title_font, curve_area.width - sample));
    out += svg_text("soft", at + Vec2{sample + 8.0, 17.0},
                    fitted(line.note, usual_font, curve_area.width + chart_gap - sample - 14.0));
    at.y += key_height;
  }
  return out;
}

std::string one_chart(const LineChart& chart, Vec2 at) {
  expects(chart.x.low < chart.x.high && chart.y.low < chart.y.high, "low < high on each axis");
  const PlotArea area{at + Vec2{axis_room_left - 10.0, 24.0}, curve_area, chart.x, chart.y};
  std::string out = svg_text("title", {area.at.x, at.y + 13.0}, chart.title) + plot_grid(area);
  for (const ChartLine& line : chart.curves) {
    out += interval_band(area, line);
  }
  for (const ChartLine& line : chart.curves) {
    out += line_of(area, line);
  }
  const double below = area.at.y + curve_area.height + axis_room_below + 14.0;
  return out + plot_x_axis(area) + plot_y_axis(area) + keys(chart.curves, {area.at.x, below});
}

std::string dot_with_whiskers(const PlotArea& area, const DotRow& row, double y) {
  expects(*row.value >= 0.0 && row.low <= *row.value && *row.value <= row.high,
          "low <= value <= high, value >= 0");
  const double low = area.x_px(row.low);
  const double high = area.x_px(row.high);
  std::string out;
  if (row.high > row.low) {
    out += svg_line("axis", {low, y}, {high, y});
    for (const double x : {low, high}) {
      out += svg_line("axis", {x, y - 4.0}, {x, y + 4.0});
    }
  }
  return out + svg_circle("dot " + row.looks, {area.x_px(*row.value), y}, 5.0);
}

}  // namespace

std::string chart_svg(const ChartSheet& sheet) {
  expects(!sheet.charts.empty(), "a sheet has at least one chart");
  const auto count = static_cast<double>(sheet.charts.size());
  const double width = 2.0 * chart_border + count * (chart_width + chart_gap) - chart_gap;
  double top = 0.0;
  std::string body = chart_head(sheet.heading, sheet.lines, width, top);
  top += 14.0;
  double left = chart_border;
  std::size_t most_keys = 0;
  for (const LineChart& chart : sheet.charts) {
    body += one_chart(chart, {left, top});
    left += chart_width + chart_gap;
    most_keys = std::max(most_keys, chart.curves.size());
  }
  const double height = top + 24.0 + curve_area.height + axis_room_below +
                        key_height * static_cast<double>(most_keys) + chart_border;
  return carded({width, height}, sheet.heading, body);
}

std::string dots_svg(const DotChart& chart) {
  expects(!chart.rows.empty(), "a chart has at least one row");
  constexpr SvgSize plot{420.0, 0.0};
  constexpr double note_room = 250.0;
  double name_room = 80.0;
  double most = 0.0;
  for (const DotRow& row : chart.rows) {
    name_room = std::max(name_room, text_width(row.name, usual_font) + 24.0);
    most = row.value ? std::max(most, row.high) : most;
  }
  const double width = 2.0 * chart_border + name_room + plot.width + note_room;
  double top = 0.0;
  std::string body = chart_head(chart.heading, chart.lines, width, top);
  top += 12.0;
  const PlotArea area{{chart_border + name_room, top},
                      {plot.width, dot_row * static_cast<double>(chart.rows.size())},
                      {chart.axis_name, chart.axis_unit, 0.0, most > 0.0 ? 1.04 * most : 1.0},
                      {}};
  for (const double value : round_ticks(0.0, area.x.high, 9)) {
    body += svg_line("grid", {area.x_px(value), top}, {area.x_px(value), top + area.size.height});
  }
  body += plot_x_axis(area);
  double y = top + 0.5 * dot_row;
  for (const DotRow& row : chart.rows) {
    body += svg_text("strong", {area.at.x - 10.0, y + 4.0}, row.name, Anchor::end);
    body += row.value ? dot_with_whiskers(area, row, y) : "";
    body += svg_text("soft", {area.at.x + plot.width + 12.0, y + 4.0},
                     fitted(row.note, usual_font, note_room));
    y += dot_row;
  }
  return carded({width, top + area.size.height + axis_room_below + chart_border}, chart.heading,
                body);
}

}  // namespace saca::report
