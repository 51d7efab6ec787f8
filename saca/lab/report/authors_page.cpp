#include "saca/lab/report/authors_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/report/base64.h"
#include "saca/lab/report/svg.h"
#include "saca/lab/report/value_png.h"

namespace saca::report {
namespace {

constexpr MapRange shown_x{-52.0, 12.0};  // a little more than the network is scaled for [m]
constexpr MapRange shown_y{-10.0, 10.0};
constexpr ValueScale shown_scale{-20.0, 5.0};  // [m]

constexpr std::string_view style = R"(
:root { color-scheme: light; }
body { margin: 2rem auto; max-width: 1500px; padding: 0 1rem; background: #fff; color: #17202a;
  font: 15px/1.45 system-ui, "Liberation Sans", sans-serif; font-variant-numeric: tabular-nums; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 1rem; }
img { width: 100%; height: auto; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { padding: .2rem .8rem; text-align: right; border-bottom: 1px solid #d6dce3; }
p { max-width: 75ch; }
)";

PlotAxis plot_axis(const std::string& name, const MapRange& range) {
  return {.name = name, .unit = "m", .low = range.low, .high = range.high};
}

ValuePicture picture(const AuthorsPage& page, const AuthorsView& view, ValueMap map,
                     const std::string& whose) {
  return {
      .map = std::move(map),
      .scale = shown_scale,
      .title = whose,
      .lines = {fmt::format("{:.0f} m/s, course {:.0f} deg", view.speed, to_degrees(view.course))},
      .x = plot_axis("x", shown_x),
      .y = plot_axis("y", shown_y),
      .value_words = "value [m], unsafe from 0",
      .outline = page.outline,
      .course = view.course};
}

/// Solved, and published.
std::array<ValuePicture, 2> pair_of(const AuthorsPage& page, const AuthorsView& view,
                                    const danger::ValueAt& value,
                                    const verification::AuthorsNetwork& network) {
  constexpr RasterSize size{320, 100};  // 0.2 m: the network takes its time
  return {picture(page, view,
                  value_map(value, shown_x, shown_y, size.columns, size.rows,
                            {0.0, 0.0, view.course, view.speed}),
                  "Solved: " + page.case_name),
          picture(page, view, authors_map(network, shown_x, shown_y, size, view),
                  "Published network: " + page.network_name)};
}

Result<std::string> elements(const std::array<ValuePicture, 2>& pair) {
  std::string html = "<div class=\"pair\">\n";
  for (const ValuePicture& one : pair) {
    const auto png = value_png(one);
    if (!png.has_value()) {
      return png.error();
    }
    html += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
                        escaped(one.title + ", " + one.lines.front()), base64(png.value()));
  }
  return html + "</div>\n";
}

std::string row(const std::string& head, const verification::Agreement& agreement,
                const std::string& means) {
  return fmt::format(
      "<tr><th>{}</th><td>{}</td><td>{:.1f} %</td><td>{:.1f} %</td><td>{:.1f} %</td><td>{:.1f} "
      "%</td>{}</tr>\n",
      head, agreement.states,
      agreement.states == 0
          ? 0.0
          : 100.0 * static_cast<double>(agreement.unsafe) / static_cast<double>(agreement.states),
      100.0 * agreement.sign_agreement(), 100.0 * agreement.false_safe_share(),
      100.0 * agreement.false_alarm_share(), means);
}

std::string table_of(const verification::AuthorsComparison& comparison) {
  std::string all =
      "<table><tr><th>speed [m/s]</th><th>states</th><th>unsafe</th><th>same sign</th>"
      "<th>false safe</th><th>false alarm</th><th>mean solved [m]</th><th>mean network [m]</th>"
      "</tr>\n";
  for (const auto& one : comparison.by_speed) {
    all += row(fmt::format("{:g}", one.speed), one.agreement,
               fmt::format("<td>{:.1f}</td><td>{:.1f}</td>", one.mean_solved, one.mean_network));
  }
  return all + row("all", comparison.all, "<td></td><td></td>") + "</table>\n";
}

}  // namespace

ValueMap authors_map(const verification::AuthorsNetwork& network, const MapRange& x,
                     const MapRange& y, const RasterSize& size, const AuthorsView& view) {
  const auto [columns, rows] = size;
  expects(x.low < x.high && y.low < y.high, "ranges are not empty");
  expects(columns >= 2 && rows >= 2, "at least 2 x 2 rectangles");
  ValueMap map{.x = x, .y = y, .columns = columns, .rows = rows, .values = {}, .inside = {}};
  std::vector<verification::AuthorsState> states;
  states.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Vec2 at = map.middle(c, r);
      states.push_back({at.x, at.y, view.course, view.speed});
    }
  }
  for (const double value : network.values(states)) {
    map.values.push_back(static_cast<float>(value));
  }
  for (const verification::AuthorsState& state : states) {
    map.inside.push_back(in_authors_range(state) ? 1 : 0);
  }
  return map;
}

Result<std::string> authors_page(const AuthorsPage& page, const danger::ValueAt& value,
                                 const verification::AuthorsNetwork& network,
                                 const verification::AuthorsComparison& comparison) {
  const std::string title = "A solved value and the published network";
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n",
      title, style);
  html +=
      "<p>Left the value of this project's solution, right that of the network which the paper's "
      "authors published; where they are 0 or more the state is unsafe (the authors' risk, "
      "clip((V + 30) / 30, 0, 1), is 1 from 0 on). The black line is 0. The network reads |y|, "
      "|yaw|, x from -50 to 0 m, |y| to 8 m, yaw to 40 deg and speed to 18 m/s on scales from 0 to "
      "1; outside that it is left blank and nothing is counted. On which obstacle, car and grip it "
      "was trained is not published with it.</p>\n";
  for (const AuthorsView& view : page.views) {
    auto pair = elements(pair_of(page, view, value, network));
    if (!pair.has_value()) {
      return pair;
    }
    html += pair.value();
  }
  html +=
      "<h2>Agreement</h2>\n<p>False safe: share of the states that are unsafe by the solution and "
      "that the network calls safe. False alarm: share of the safe states that it calls "
      "unsafe. Each metre, 5 deg and m/s counts alike.</p>\n" +
      table_of(comparison);
  if (comparison.outside > 0) {
    html += fmt::format("<p>{} states of the network's range lie outside the solution.</p>\n",
                        comparison.outside);
  }
  return html + "</body></html>\n";
}

Result<std::string> authors_png(const AuthorsPage& page, const danger::ValueAt& value,
                                const verification::AuthorsNetwork& network) {
  std::vector<ValuePicture> all;
  for (const AuthorsView& view : page.views) {
    std::ranges::move(pair_of(page, view, value, network), std::back_inserter(all));
  }
  return value_png(all, 2);
}

}  // namespace saca::report
