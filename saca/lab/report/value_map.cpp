#include "saca/lab/report/value_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "saca/base/config/config.h"
#include "saca/base/core/contract.h"

namespace saca::report {
namespace {

constexpr int outline_points = 96;

/// Of a curved outline.
Vec2 on_ellipse(int point, double length, double width) {
  const double angle = 2.0 * std::numbers::pi * point / outline_points;
  return {0.5 * length * std::cos(angle), 0.5 * width * std::sin(angle)};
}

/// Where the value passes 0 between two places, of opposite signs.
Vec2 crossing(Vec2 a, Vec2 b, double value_a, double value_b) {
  return a + (value_a / (value_a - value_b)) * (b - a);
}

/// A square between four middles, counter-clockwise from the lower left one.
struct Square {
  std::array<Vec2, 4> at;
  std::array<double, 4> value{};

  [[nodiscard]] Vec2 on_side(std::size_t side) const {
    const std::size_t next = (side + 1) % 4;
    return crossing(at[side], at[next], value[side], value[next]);
  }
};

void add_zero(std::vector<std::array<Vec2, 2>>& line, const Square& square) {
  std::array<std::size_t, 4> sides{};
  std::size_t count = 0;
  for (std::size_t side = 0; side < 4; ++side) {
    if ((square.value[side] >= 0.0) != (square.value[(side + 1) % 4] >= 0.0)) {
      sides[count++] = side;
    }
  }
  if (count == 2) {
    line.push_back({square.on_side(sides[0]), square.on_side(sides[1])});
  } else if (count == 4) {
    // A saddle: corners of the middle's sign are joined, the others are cut off.
    const double middle =
        0.25 * (square.value[0] + square.value[1] + square.value[2] + square.value[3]);
    const std::size_t cut = (square.value[0] >= 0.0) == (middle >= 0.0) ? 1 : 0;
    line.push_back({square.on_side((cut + 3) % 4), square.on_side(cut)});
    line.push_back({square.on_side(cut + 1), square.on_side((cut + 2) % 4)});
  }
}

/// The least of 1, 2, 5, 10, ... x 10^n that is not below `value`, which is > 0.
double rounded_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade * (1.0 + 1e-6)) {  // values are floats
      return step * decade;
    }
  }
  return 10.0 * decade;
}

Rgb mixed(const std::array<Rgb, 6>& colours, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const double rest = at - static_cast<double>(low);
  const auto mix = [rest](unsigned char a, unsigned char b) {
    return static_cast<unsigned char>(std::lround(a + rest * (b - a)));
  };
  const Rgb& a = colours[low];
  const Rgb& b = colours[low + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

}  // namespace

Vec2 ValueMap::middle(int column, int row) const {
  return {x.low + (column + 0.5) * (x.high - x.low) / columns,
          y.low + (row + 0.5) * (y.high - y.low) / rows};
}

ValueMap value_map(const danger::ValueAt& value, const MapRange& x, const MapRange& y, int columns,
                   int rows, const danger::State& others) {
  expects(x.low < x.high && y.low < y.high, "low < high");
  expects(columns >= 2 && rows >= 2, "columns >= 2, rows >= 2");
  ValueMap map{.x = x, .y = y, .columns = columns, .rows = rows, .values = {}, .inside = {}};
  const std::size_t size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  map.values.reserve(size);
  map.inside.reserve(size);
  danger::State state = others;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 at = map.middle(column, row);
      state[0] = at.x;
      state[1] = at.y;
      const danger::LookupResult looked = value(state);
      map.values.push_back(static_cast<float>(looked.value));
      map.inside.push_back(looked.inside ? 1 : 0);
    }
  }
  return map;
}

ValueMap value_map(const danger::ValueTable& table, const MapRange& x, const MapRange& y,
                   int columns, int rows, const danger::State& others) {
  expects(table.grid().axes.size() >= 2, "the table has at least two axes");
  return value_map([&](const danger::State& state) { return table.at(state); }, x, y, columns, rows,
                   others);
}

double zoom_on_danger(const ValueMap& map, Vec2 middle) {
  constexpr double most = 8.0;
  constexpr double share = 0.6;
  double zoom = most;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const std::size_t i = map.index(column, row);
      if (map.inside[i] != 0 && map.values[i] >= 0.0F) {
        const Vec2 at = map.middle(column, row) - middle;
        const double room_x = at.x < 0.0 ? middle.x - map.x.low : map.x.high - middle.x;
        const double room_y = at.y < 0.0 ? middle.y - map.y.low : map.y.high - middle.y;
        zoom = std::min({zoom, share * room_x / std::abs(at.x), share * room_y / std::abs(at.y)});
      }
    }
  }
  return std::max(zoom, 1.0);
}

Vec2 zoom_middle(const MapRange& x, const MapRange& y) {
  const auto middle = [](const MapRange& range) {
    return range.low < 0.0 && range.high > 0.0 ? 0.0 : 0.5 * (range.low + range.high);
  };
  return {middle(x), middle(y)};
}

MapRange zoomed(const MapRange& range, double middle, double zoom) {
  return {middle + (range.low - middle) / zoom, middle + (range.high - middle) / zoom};
}

std::vector<std::array<Vec2, 2>> zero_line(const ValueMap& map) {
  std::vector<std::array<Vec2, 2>> line;
  for (int row = 0; row + 1 < map.rows; ++row) {
    for (int column = 0; column + 1 < map.columns; ++column) {
      Square square;
      bool inside = true;
      constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      for (std::size_t i = 0; i < 4; ++i) {
        const int c = column + corners[i][0];
        const int r = row + corners[i][1];
        square.at[i] = map.middle(c, r);
        square.value[i] = static_cast<double>(map.values[map.index(c, r)]);
        inside = inside && map.inside[map.index(c, r)] != 0;
      }
      if (inside) {
        add_zero(line, square);
      }
    }
  }
  return line;
}

ValueScale scale_of(const std::vector<float>& values) {
  ValueScale scale;
  if (!values.empty()) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    scale.lowest = *least < 0.0F ? -rounded_up(-static_cast<double>(*least)) : scale.lowest;
    scale.highest = *most > 0.0F ? rounded_up(static_cast<double>(*most)) : scale.highest;
  }
  return scale;
}

Rgb colour_of(double value, const ValueScale& scale) {
  return value >= 0.0 ? mixed(danger_colours, value / scale.highest)
                      : mixed(safety_colours, value / scale.lowest);
}

std::vector<Vec2> obstacle_outline(std::string_view problem_toml) {
  const auto document = config::Document::parse(problem_toml, "problem");
  if (!document.has_value()) {
    return {};
  }
  auto obstacle = document.value().root().optional_table("obstacle");
  if (!obstacle) {
    return {};
  }
  const std::string shape = obstacle->optional_text("shape").value_or("");
  const double length = obstacle->optional_number("length_m").value_or(0.0);
  const double width = obstacle->optional_number("width_m").value_or(0.0);
  const double x = 0.5 * length;
  if (shape == "segment" && length > 0.0) {
    return {{-x, 0.0}, {x, 0.0}};
  }
  if (!(length > 0.0 && width > 0.0)) {
    return {};
  }
  if (shape == "box") {
    const double y = 0.5 * width;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  }
  std::vector<Vec2> outline;
  for (int i = 0; i < outline_points && shape == "ellipse"; ++i) {
    outline.push_back(on_ellipse(i, length, width));
  }
  return outline;
}

std::optional<std::string> problem_name(std::string_view problem_toml) {
  const auto document = config::Document::parse(problem_toml, "problem");
  return document.has_value() ? document.value().root().optional_text("name") : std::nullopt;
}

}  // namespace saca::report
