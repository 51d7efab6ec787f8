#include "saca/lab/report/value_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/lab/report/base64.h"
#include "saca/lab/report/value_map.h"
#include "saca/thinking/danger/obstacle_frame.h"

namespace saca::report {
namespace {

using nlohmann::json;
using Picked = std::vector<std::size_t>;  // points, or snapshots, that the page gets

constexpr std::size_t most_page_times = 12;

/// Every `step`-th of `count`; the last too, unless the axis goes on at the first.
Picked every(std::size_t step, std::size_t count, bool with_last) {
  Picked picked;
  for (std::size_t i = 0; i < count; i += step) {
    picked.push_back(i);
  }
  if (with_last && picked.back() != count - 1) {
    picked.push_back(count - 1);
  }
  return picked;
}

Picked picked_times(std::size_t count) {
  Picked picked;
  const std::size_t wanted = std::min(count, most_page_times);
  for (std::size_t i = 0; i < wanted; ++i) {
    picked.push_back(wanted == 1 ? 0 : i * (count - 1) / (wanted - 1));
  }
  return picked;
}

std::vector<Picked> picked_points(const danger::Grid& grid, std::size_t most_cells) {
  std::vector<Picked> picked;
  std::vector<std::size_t> steps(grid.axes.size(), 1);
  const auto pick = [&](std::size_t d) {
    const danger::Axis& axis = grid.axes[d];
    return every(steps[d], static_cast<std::size_t>(axis.points),
                 axis.edge != danger::Edge::periodic);
  };
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    picked.push_back(pick(d));
  }
  const auto cells = [&] {
    std::size_t product = 1;
    for (const Picked& points : picked) {
      product *= points.size();
    }
    return product;
  };
  while (cells() > most_cells) {
    const auto longest =
        std::max_element(picked.begin(), picked.end(),
                         [](const Picked& a, const Picked& b) { return a.size() < b.size(); });
    if (longest->size() <= 3) {
      break;
    }
    const auto d = static_cast<std::size_t>(longest - picked.begin());
    ++steps[d];
    picked[d] = pick(d);
  }
  return picked;
}

/// 128 is 0; the root is what is rounded, and no sign is lost.
char byte_of(float value, const ValueScale& extent) {
  const bool danger = value >= 0.0F;
  const double share = static_cast<double>(value) / (danger ? extent.highest : extent.lowest);
  const auto root = std::lround(127.0 * std::sqrt(std::min(share, 1.0)));
  return static_cast<char>(danger ? 128 + root : 128 - std::max(1L, root));
}

std::string bytes_of(const std::vector<float>& values, const danger::Grid& grid,
                     const std::vector<Picked>& picked, const ValueScale& extent) {
  std::string bytes;
  std::vector<std::size_t> at(picked.size(), 0);
  const std::vector<std::size_t> steps = danger::strides(grid);
  for (std::size_t d = 0; d < picked.size();) {
    std::size_t number = 0;
    for (d = 0; d < picked.size(); ++d) {
      number += picked[d][at[d]] * steps[d];
    }
    bytes += byte_of(values[number], extent);
    for (d = 0; d < picked.size() && ++at[d] == picked[d].size(); ++d) {
      at[d] = 0;
    }
  }
  return bytes;
}

json axis_json(const danger::Axis& axis, const Picked& picked) {
  const ReadUnit read = read_unit(axis.name);
  json coordinates = json::array();
  for (const std::size_t point : picked) {
    coordinates.push_back(danger::coordinate(axis, static_cast<int>(point)));
  }
  return {{"name", axis.name},
          {"unit", read.unit},
          {"factor", read.factor},
          {"edge", name_of(axis.edge, danger::edge_names)},
          {"last", axis.last},
          {"points", axis.points},
          {"turned", axis.turned ? json(*axis.turned) : json()},
          {"coordinates", coordinates}};
}

Picked ends_of(const danger::Axis& axis) {
  const auto last = static_cast<std::size_t>(axis.points) - 1;
  return axis.edge == danger::Edge::periodic ? Picked{0} : Picked{0, last};
}

json colours_json(const std::array<Rgb, 6>& colours) {
  json list = json::array();
  for (const Rgb& c : colours) {
    list.push_back({c.red, c.green, c.blue});
  }
  return list;
}

/// The least and the greatest of all picked snapshots; never empty.
ValueScale extent_of(const std::vector<std::vector<float>>& snapshots) {
  ValueScale extent{.lowest = -1e-6, .highest = 1e-6};
  for (const std::vector<float>& values : snapshots) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    extent.lowest = std::min(extent.lowest, static_cast<double>(*least));
    extent.highest = std::max(extent.highest, static_cast<double>(*most));
  }
  return extent;
}

}  // namespace

ReadUnit read_unit(std::string_view axis_name) {
  if (axis_name == "x" || axis_name == "y" || axis_name == "ahead" || axis_name == "left") {
    return {"m", 1.0};
  }
  if (axis_name == "course" || axis_name == "heading" || axis_name == "turned") {
    return {"deg", 180.0 / std::numbers::pi};
  }
  return {axis_name == "speed" || axis_name == "v" ? "m/s" : "", 1.0};
}

std::vector<danger::Axis> shown_axes(const danger::Solution& solved, double course) {
  return danger::view_of(solved) == danger::View::ego
             ? danger::axes_in_obstacle_frame(solved.grid, course)
             : solved.grid.axes;
}

namespace {

/// Axes that the page shows instead of the grid's; null: none.
json shown_json(const danger::Solution& solved, const ValueView& view) {
  if (danger::view_of(solved) != danger::View::ego) {
    return {};
  }
  json shown = json::array();
  for (const danger::Axis& axis : shown_axes(solved, view.others[2])) {
    shown.push_back(axis_json(axis, ends_of(axis)));
  }
  return shown;
}

json outline_json(std::string_view problem) {
  json outline = json::array();
  for (const Vec2 p : obstacle_outline(problem)) {
    outline.push_back({p.x, p.y});
  }
  return outline;
}

}  // namespace

std::string value_json(const danger::Solution& solved, const ValueView& view,
                       std::size_t most_values) {
  const danger::Grid& grid = solved.grid;
  expects(grid.axes.size() >= 2, "the grid has at least two axes");
  expects(view.time < solved.times.size(), "there is such a snapshot");
  const Picked times = picked_times(solved.times.size());
  const std::vector<Picked> picked = picked_points(grid, most_values / times.size());
  std::vector<std::vector<float>> snapshots;
  json times_s = json::array();
  for (const std::size_t time : times) {
    snapshots.push_back(danger::snapshot(solved, time));
    times_s.push_back(solved.times[time]);
  }
  const ValueScale extent = extent_of(snapshots);
  std::string bytes;
  for (const std::vector<float>& values : snapshots) {
    bytes += bytes_of(values, grid, picked, extent);
  }
  json axes = json::array();
  json others = json::array();
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    axes.push_back(axis_json(grid.axes[d], picked[d]));
    others.push_back(view.others[d]);
  }
  const auto start = std::lower_bound(times.begin(), times.end(), view.time) - times.begin();
  const ValueScale scale =
      scale_of({static_cast<float>(extent.lowest), static_cast<float>(extent.highest)});
  // Half a step at the far end of the longer side: d(r^2) = 2 r dr at r = 1.
  const double rounding = std::max(-extent.lowest, extent.highest) / 127.0;
  const json page{
      {"schema", "saca.value_page/1"},
      {"title", view.title},
      {"problem", solved.problem},
      {"complete", solved.complete},
      {"times_s", times_s},
      {"start", {{"time", start}, {"others", others}, {"zoom", view.zoom}}},
      {"axes", axes},
      {"shown", shown_json(solved, view)},
      {"value_words", "V [m]"},
      {"value_unit", "m"},
      {"extent", {{"lowest", extent.lowest}, {"highest", extent.highest}}},
      {"scale", {{"lowest", scale.lowest}, {"highest", scale.highest}}},
      {"rounding", rounding},
      {"colours",
       {{"danger", colours_json(danger_colours)}, {"safety", colours_json(safety_colours)}}},
      {"outline", outline_json(solved.problem)},
      {"values", base64(bytes)}};
  return page.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace saca::report
