#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/lab/report/plot_axes.h"
#include "saca/lab/report/svg.h"

namespace saca::report {

/// Colours of curves and dots that mean no policy: distinct for colour-blind readers.
enum class ChartColour { blue, orange, green, purple, grey, ink };

/// A line of a chart.
struct ChartLine {
  std::string name;
  std::string note;  ///< below the name in the legend: its source; empty: none
  ChartColour colour = ChartColour::blue;
  bool dashed = false;
  std::vector<Vec2> points;  ///< in the axes' units, in order of x
  std::vector<double> low;   ///< of an interval of y, or empty   (one per point)
  std::vector<double> high;
};

struct LineChart {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<ChartLine> curves;
};

/// Charts beside each other under one heading, each with its legend.
struct ChartSheet {
  std::string heading;
  std::vector<std::string> lines;  ///< below it
  std::vector<LineChart> charts;   ///< at least one
};

/// @throws ContractViolation  if there is no chart, an axis is empty or an interval has not one end
///                            per point
[[nodiscard]] std::string chart_svg(const ChartSheet& sheet);

/// A mean with its interval.
struct DotRow {
  std::string name;
  std::string looks;            ///< class of an area: `policy_area`
  std::string note;             ///< to the right; empty: none
  std::optional<double> value;  ///< nullopt: only the note
  double low = 0.0;             ///< 95 % interval
  double high = 0.0;
};

struct DotChart {
  std::string heading;
  std::vector<std::string> lines;
  std::string axis_name;
  std::string axis_unit;
  std::vector<DotRow> rows;  ///< from the top, at least one
};

/// Dots with whiskers over one axis from zero: expected harm of the eight policies.
/// @throws ContractViolation  if there is no row, or a value lies outside its interval or below 0
[[nodiscard]] std::string dots_svg(const DotChart& chart);

}  // namespace saca::report
