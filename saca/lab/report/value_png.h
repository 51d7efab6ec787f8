#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/report/plot_axes.h"
#include "saca/lab/report/value_map.h"

namespace saca::report {

/// A map with all that a reader needs.
struct ValuePicture {
  ValueMap map;
  ValueScale scale;
  std::string title;
  std::vector<std::string> lines;  ///< below it
  PlotAxis x, y;                   ///< over the map's ranges, in the unit that is to be read
  std::string value_words;         ///< beside the colours
  std::vector<Vec2> outline;       ///< of the obstacle, in the map's coordinates; empty: none
  std::optional<double> course;    ///< in which the ego moves [rad]; nullopt: no arrow
};

/// How many rectangles a map should have for `value_png`: one for each pixel of the plot. Axes of
/// equal units are drawn to scale, within reason.
struct RasterSize {
  int columns = 0;
  int rows = 0;
};
[[nodiscard]] RasterSize raster_size(const PlotAxis& x, const PlotAxis& y);

/// Pictures as bytes of one PNG file, row by row: values as colours, the zero level as a black
/// line, the obstacle in red, axes, colour bar.
/// @param columns  >= 1
/// @return  an error when there is no memory for it
[[nodiscard]] Result<std::string> value_png(std::span<const ValuePicture> pictures, int columns);
[[nodiscard]] Result<std::string> value_png(const ValuePicture& picture);

}  // namespace saca::report
