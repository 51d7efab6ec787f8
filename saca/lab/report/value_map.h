#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/vec2.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::report {

/// From `low` to `high`, in the axis' unit; low < high.
struct MapRange {
  double low = 0.0;
  double high = 1.0;
};

/// A solved value over the plane of its first two coordinates, in small rectangles.
struct ValueMap {
  MapRange x, y;
  int columns = 0;
  int rows = 0;
  std::vector<float> values;  ///< at each middle; row by row from the lowest y, x runs first
  std::vector<char> inside;   ///< 0: beyond the table's open ends, where `values` are the nearest

  [[nodiscard]] Vec2 middle(int column, int row) const;
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// @param others   the further coordinates: of the avoidance problem {0, 0, course, speed}; the
///                 first two are not read
/// @param columns, rows  >= 2
/// @throws ContractViolation  if a range is empty
[[nodiscard]] ValueMap value_map(const danger::ValueAt& value, const MapRange& x, const MapRange& y,
                                 int columns, int rows, const danger::State& others);
/// @throws ContractViolation  likewise, or if the table has one axis
[[nodiscard]] ValueMap value_map(const danger::ValueTable& table, const MapRange& x,
                                 const MapRange& y, int columns, int rows,
                                 const danger::State& others);

/// How far to look closer at the middle of the plane, so that what is unsafe there can be seen: the
/// greatest of 1 to 8 at which all of a map's unsafe places inside lie within 60 % of each range.
/// @param middle  that stays where it is
[[nodiscard]] double zoom_on_danger(const ValueMap& map, Vec2 middle);

/// Origin where the ranges have it inside, else their middles.
[[nodiscard]] Vec2 zoom_middle(const MapRange& x, const MapRange& y);
[[nodiscard]] MapRange zoomed(const MapRange& range, double middle, double zoom);

/// Where the value is 0 between the middles: pieces of line, in the plane's coordinates. Marching
/// squares; nothing is drawn where a corner lies outside the table.
[[nodiscard]] std::vector<std::array<Vec2, 2>> zero_line(const ValueMap& map);

/// 8 bits each.
struct Rgb {
  unsigned char red = 0, green = 0, blue = 0;
  bool operator==(const Rgb&) const = default;
};

/// What colours mean. Each side of 0 has its own scale: danger [0, highest] turns to dark red,
/// safety [lowest, 0] to dark blue; 0 is white.
struct ValueScale {
  double lowest = -1.0;  ///< < 0
  double highest = 1.0;  ///< > 0
};

/// Colours from 0 outwards, evenly spaced.
constexpr std::array<Rgb, 6> danger_colours{{{250, 247, 244},
                                             {253, 219, 199},
                                             {244, 165, 130},
                                             {214, 96, 77},
                                             {178, 24, 43},
                                             {103, 0, 31}}};
constexpr std::array<Rgb, 6> safety_colours{{{244, 248, 250},
                                             {209, 229, 240},
                                             {146, 197, 222},
                                             {67, 147, 195},
                                             {33, 102, 172},
                                             {5, 48, 97}}};

/// A scale that spans a table's values, of round numbers.
[[nodiscard]] ValueScale scale_of(const std::vector<float>& values);
[[nodiscard]] Rgb colour_of(double value, const ValueScale& scale);

/// The outline of what is to be avoided, as a case's file tells it under [obstacle]: shape
/// ("ellipse", "box", "segment"), length_m and width_m, whole lengths along x and y, its middle at
/// the origin [m]. Closed: the last point joins the first.
/// @return  empty when there is none, or it is told in another way
[[nodiscard]] std::vector<Vec2> obstacle_outline(std::string_view problem_toml);

/// The case's `name`; nullopt: none.
[[nodiscard]] std::optional<std::string> problem_name(std::string_view problem_toml);

}  // namespace saca::report
