#include "saca/lab/report/map_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "saca/base/core/contract.h"
#include "saca/lab/report/cell_areas.h"
#include "saca/lab/report/map_legend.h"
#include "saca/lab/report/palette.h"
#include "saca/lab/report/plot_axes.h"

namespace saca::report {
namespace {

using manoeuvre::PolicyId;

constexpr SvgSize map_size{560.0, 420.0};
constexpr SvgSize strip_size{560.0, 300.0};
constexpr double band_height = 26.0;  // of a strip's cells [px]
constexpr double refusal_row = 12.0;  // below it, for each policy that is refused somewhere [px]

/// Where cells begin and end: half-way between the values; as far beyond the outermost.
std::vector<double> bounds(const MapAxis& axis) {
  const std::vector<double>& v = axis.values;
  expects(!v.empty(), "an axis has at least one value");
  std::vector<double> edges;
  const double first = v.size() > 1 ? 0.5 * (v[1] - v[0]) : 0.5;
  edges.push_back(v.front() - first);
  for (std::size_t i = 1; i < v.size(); ++i) {
    expects(v[i - 1] < v[i], "values of an axis increase");
    edges.push_back(0.5 * (v[i - 1] + v[i]));
  }
  const double last = v.size() > 1 ? 0.5 * (v.back() - v[v.size() - 2]) : 0.5;
  edges.push_back(v.back() + last);
  return edges;
}

PlotAxis plot_axis(const MapAxis& axis) {
  const std::vector<double> edges = bounds(axis);
  return {axis.name, axis.unit, edges.front(), edges.back()};
}

/// Paler where less is at stake: 1 to 4.
int margin_level(double margin) {
  const auto above = std::count_if(std::begin(margin_steps), std::end(margin_steps),
                                   [margin](double step) { return margin >= step; });
  return static_cast<int>(above) + 1;
}

bool refuses_any(const MapCell& cell, std::span<const PolicyId> policies) {
  return std::any_of(policies.begin(), policies.end(),
                     [&](PolicyId policy) { return refuses(cell, policy); });
}

/// What only these pictures have: red lines, sparse, so that what lies below is seen.
constexpr std::string_view refused_look =
    "<defs><pattern id=\"saca-refused\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(-45)\"><rect width=\"1.2\" height=\"9\" fill=\"#c00036\"/></pattern>"
    "<style>.saca .refused{fill:url(#saca-refused)}</style></defs>\n";

std::string cell_class(const MapCell& cell) {
  switch (cell.verdict) {
    case MapVerdict::no_risk:
      return "no-risk";
    case MapVerdict::unplayable:
      return "unplayable";
    case MapVerdict::decided:
      break;
  }
  return fmt::format("{} m{}", policy_area(cell.best), margin_level(cell.margin));
}

/// A grid of cells in its place.
class CellGrid {
 public:
  CellGrid(std::span<const MapCell> cells, const PlotArea& area, const MapAxis& x,
           std::vector<double> y_edges)
      : cells_(cells), area_(area), x_edges_(bounds(x)), y_edges_(std::move(y_edges)) {
    expects(cells.size() == columns() * rows(), "one cell for each combination of values");
    for (const MapCell& cell : cells) {
      expects(cell.margin >= 0.0, "margin >= 0");
    }
  }

  [[nodiscard]] std::size_t columns() const { return x_edges_.size() - 1; }
  [[nodiscard]] std::size_t rows() const { return y_edges_.size() - 1; }

  [[nodiscard]] std::string areas() const {
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    std::string stripes;
    for (std::size_t row = 0; row < rows(); ++row) {
      for (std::size_t from = 0, to = 0; from < columns(); from = to) {
        const std::string looks = cell_class(at(row, from));
        while (to < columns() && cell_class(at(row, to)) == looks) {
          ++to;
        }
        out += block(looks, row, from, to);
        const MapCell& cell = at(row, from);
        if (cell.verdict == MapVerdict::decided && manoeuvre::side(cell.best) < 0) {
          stripes += block("right", row, from, to);
        }
      }
    }
    return out + stripes + "</g>\n";
  }

  /// Over cells in which a policy of these is refused.
  [[nodiscard]] std::string refusals(std::span<const PolicyId> policies) const {
    std::string out;
    for (std::size_t row = 0; row < rows(); ++row) {
      for (std::size_t from = 0, to = 0; from < columns(); from = to) {
        const bool refused = refuses_any(at(row, from), policies);
        while (to < columns() && refuses_any(at(row, to), policies) == refused) {
          ++to;
        }
        out += refused ? block("refused", row, from, to) : "";
      }
    }
    return out.empty() ? "" : "<g shape-rendering=\"crispEdges\">\n" + out + "</g>\n";
  }

  /// Lines between areas.
  [[nodiscard]] std::string outlines() const {
    std::string path;
    for (std::size_t row = 0; row < rows(); ++row) {
      for (std::size_t column = 0; column < columns(); ++column) {
        const int own = area_key(at(row, column));
        if (column + 1 < columns() && area_key(at(row, column + 1)) != own) {
          segment(path, column + 1, row, column + 1, row + 1);
        }
        if (row + 1 < rows() && area_key(at(row + 1, column)) != own) {
          segment(path, column, row + 1, column + 1, row + 1);
        }
      }
    }
    return path.empty() ? ""
                        : fmt::format(
                              "<path class=\"outline\" fill=\"none\" stroke=\"#17202a\" "
                              "stroke-width=\"0.8\" d=\"{}\"/>\n",
                              path);
  }

  /// The policies' names in their areas: where an area is widest, and there near its middle.
  [[nodiscard]] std::string names() const {
    std::vector<int> keys;
    for (const MapCell& cell : cells_) {
      keys.push_back(area_key(cell));
    }
    std::string out;
    for (const std::size_t cell : area_centres(keys, columns())) {
      out += name_at(cell / columns(), cell % columns());
    }
    return out;
  }

 private:
  [[nodiscard]] const MapCell& at(std::size_t row, std::size_t column) const {
    return cells_[row * columns() + column];
  }
  [[nodiscard]] Vec2 corner(std::size_t column, std::size_t row) const {
    return area_.px(x_edges_[column], y_edges_[row]);
  }

  [[nodiscard]] std::string block(std::string_view looks, std::size_t row, std::size_t from,
                                  std::size_t to) const {
    const Vec2 low = corner(from, row);
    const Vec2 high = corner(to, row + 1);
    return svg_rect(looks, {low.x, high.y}, {high.x - low.x, low.y - high.y});
  }

  void segment(std::string& path, std::size_t c0, std::size_t r0, std::size_t c1,
               std::size_t r1) const {
    const Vec2 a = corner(c0, r0);
    const Vec2 b = corner(c1, r1);
    path += fmt::format("M{} {}L{} {}", svg_number(a.x), svg_number(a.y), svg_number(b.x),
                        svg_number(b.y));
  }

  /// Left out where the area is too small for it.
  [[nodiscard]] std::string name_at(std::size_t row, std::size_t column) const {
    const MapCell& cell = at(row, column);
    if (cell.verdict == MapVerdict::unplayable) {
      return "";
    }
    const std::string_view name =
        cell.verdict == MapVerdict::no_risk ? "no risk" : manoeuvre::name(cell.best);
    const auto alike = [&](std::size_t k) { return area_key(at(row, k)) == area_key(cell); };
    std::size_t from = column;
    std::size_t to = column + 1;
    while (from > 0 && alike(from - 1)) {
      --from;
    }
    while (to < columns() && alike(to)) {
      ++to;
    }
    const Vec2 low = corner(from, row);
    const Vec2 high = corner(to, row + 1);
    if (high.x - low.x < text_width(name, usual_font) + 4.0) {
      return "";
    }
    return svg_text("halo strong", {0.5 * (low.x + high.x), 0.5 * (low.y + high.y) + 4.0}, name,
                    Anchor::middle);
  }

  std::span<const MapCell> cells_;
  const PlotArea& area_;
  std::vector<double> x_edges_;
  std::vector<double> y_edges_;
};

// --- the whole --------------------------------------------------------------------------------

double map_head_height(const std::vector<std::string>& lines) {
  return map_border + 26.0 + 16.0 * static_cast<double>(lines.size()) + 6.0;
}

std::string map_head(std::string_view title, const std::vector<std::string>& lines, double width) {
  double y = map_border + 16.0;
  std::string out =
      svg_text("heading", {map_border, y}, fitted(title, heading_font, width - 2.0 * map_border));
  for (const std::string& line : lines) {
    y += 16.0;
    out += svg_text("soft", {map_border, y}, fitted(line, usual_font, width - 2.0 * map_border));
  }
  return out;
}

std::string whole(SvgSize size, std::string_view title, const std::vector<std::string>& lines,
                  const std::string& body) {
  return svg_document(size, title,
                      svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}) +
                          map_head(title, lines, size.width) + body);
}

/// Is the scenario as it is among the values that are drawn?
bool shows_nominal(const MapAxis& axis) {
  const std::vector<double> edges = bounds(axis);
  return axis.nominal && *axis.nominal >= edges.front() && *axis.nominal <= edges.back();
}

/// Where the plot's right neighbour begins.
double legend_left(const PlotArea& area) {
  return area.at.x + area.size.width + 22.0;
}

std::string curve(const PlotArea& area, const PolicyStrip& strip, const HarmCurve& curve) {
  expects(curve.harm.size() == strip.x.values.size(), "a curve has one number per value");
  expects(curve.low.size() == curve.high.size(), "an interval has two ends");
  std::string out;
  std::vector<Vec2> line;
  std::vector<Vec2> upper;
  std::vector<Vec2> lower;
  const auto finish = [&] {
    if (!upper.empty()) {
      upper.insert(upper.end(), lower.rbegin(), lower.rend());
      out = svg_polygon("band " + policy_area(curve.policy), upper) + out;
    }
    if (line.size() == 1) {
      out += svg_circle("dot " + policy_area(curve.policy), line.front(), 3.0);
    } else if (!line.empty()) {
      out += svg_polyline("curve " + policy_stroke(curve.policy), line);
    }
    line.clear();
    upper.clear();
    lower.clear();
  };
  for (std::size_t i = 0; i < curve.harm.size(); ++i) {
    if (!curve.harm[i]) {
      finish();
      continue;
    }
    const double x = strip.x.values[i];
    line.push_back(area.px(x, *curve.harm[i]));
    if (!curve.low.empty()) {
      expects(curve.low.size() == curve.harm.size(), "an interval for each value");
      upper.push_back(area.px(x, curve.high[i]));
      lower.push_back(area.px(x, curve.low[i]));
    }
  }
  finish();
  return out;
}

double most_harm(const PolicyStrip& strip) {
  double most = 1e-3;
  for (const HarmCurve& one : strip.curves) {
    for (std::size_t i = 0; i < one.harm.size(); ++i) {
      most = std::max(most, one.harm[i].value_or(0.0));
      most = i < one.high.size() && one.harm[i] ? std::max(most, one.high[i]) : most;
    }
  }
  return most;
}

/// Below the band a row for each policy that is refused somewhere, with a bar where it is.
std::string refusal_rows(const PolicyStrip& strip, const PlotArea& band,
                         std::span<const PolicyId> refused) {
  std::string out(refused.empty() ? "" : refused_look);
  double y = band.at.y + band_height + 2.0;
  for (const PolicyId& policy : refused) {
    const PlotArea row{{band.at.x, y}, {band.size.width, refusal_row - 2.0}, band.x, {}};
    out += CellGrid(strip.cells, row, strip.x, {0.0, 1.0}).refusals({&policy, 1});
    out += svg_text("soft", {band.at.x - 6.0, y + refusal_row - 3.0}, manoeuvre::name(policy),
                    Anchor::end);
    y += refusal_row;
  }
  return out;
}

}  // namespace

std::string map_svg(const PolicyMap& map) {
  const double top = map_head_height(map.lines);
  const PlotArea area{
      {map_border + axis_room_left - 10.0, top}, map_size, plot_axis(map.x), plot_axis(map.y)};
  const CellGrid grid(map.cells, area, map.x, bounds(map.y));
  MapLegend legend({legend_left(area), top + 8.0});
  legend.verdicts(map.cells);
  legend.gap();
  legend.margins();
  legend.refusals(map.cells);
  const std::vector<PolicyId> refused = refused_somewhere(map.cells);
  std::string body = (refused.empty() ? "" : std::string(refused_look)) + grid.areas() +
                     grid.refusals(refused) + grid.outlines() + grid.names();
  body += svg_rect("frame", area.at, area.size) + plot_x_axis(area) + plot_y_axis(area);
  if (shows_nominal(map.x) && shows_nominal(map.y)) {
    body += nominal_mark(area.px(*map.x.nominal, *map.y.nominal));
    legend.gap();
    legend.sign(nominal_mark(legend.at() + Vec2{9.0, 0.0}), "the scenario as it is");
  }
  body += legend.body();
  const double bottom = std::max(top + map_size.height + axis_room_below, legend.at().y);
  return whole({legend_left(area) + legend_width, bottom + 8.0}, map.title, map.lines, body);
}

std::string strip_svg(const PolicyStrip& strip) {
  const double top = map_head_height(strip.lines);
  PlotArea band{{map_border + axis_room_left - 10.0, top},
                {strip_size.width, band_height},
                plot_axis(strip.x),
                {}};
  const CellGrid grid(strip.cells, band, strip.x, {0.0, 1.0});
  const std::vector<PolicyId> refused = refused_somewhere(strip.cells);
  const double rows_height = refusal_row * static_cast<double>(refused.size());
  const PlotArea area{{band.at.x, top + band_height + rows_height + 10.0},
                      strip_size,
                      band.x,
                      {"expected harm", "", 0.0, 1.05 * most_harm(strip)}};
  std::string body = grid.areas() + grid.outlines() + grid.names() +
                     svg_rect("frame", band.at, band.size) + plot_grid(area);
  body += refusal_rows(strip, band, refused);
  MapLegend legend({legend_left(area), top + 8.0});
  legend.verdicts(strip.cells);
  legend.refusals(strip.cells);
  legend.gap();
  legend.heading("expected harm");
  for (const HarmCurve& one : strip.curves) {
    body += curve(area, strip, one);
    const Vec2 at = legend.at();
    legend.sign(svg_line("curve " + policy_stroke(one.policy), at, at + Vec2{18.0, 0.0}),
                fmt::format("{} {}", manoeuvre::index(one.policy), manoeuvre::name(one.policy)));
  }
  body += plot_x_axis(area) + plot_y_axis(area);
  if (shows_nominal(strip.x)) {
    const double x = area.x_px(*strip.x.nominal);
    body += svg_line("nominal", {x, top - 4.0}, {x, area.at.y + area.size.height});
    const Vec2 at = legend.at() + Vec2{9.0, 0.0};
    legend.sign(svg_line("nominal", at - Vec2{0.0, 6.0}, at + Vec2{0.0, 6.0}),
                "the scenario as it is");
  }
  body += legend.body();
  const double bottom = std::max(area.at.y + strip_size.height + axis_room_below, legend.at().y);
  return whole({legend_left(area) + legend_width, bottom + 8.0}, strip.title, strip.lines, body);
}

}  // namespace saca::report
