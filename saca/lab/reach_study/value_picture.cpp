#include "saca/lab/reach_study/value_picture.h"

#include <vector>

#include "saca/base/core/vec2.h"
#include "saca/lab/reach_study/value_view.h"
#include "saca/lab/report/value_map.h"
#include "saca/lab/report/value_png.h"
#include "saca/thinking/danger/obstacle_frame.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::reach_study {
namespace {

using danger::Solution;

/// The whole axis; a mirrored one to both sides, where its mirror turns no axis of the plane.
report::MapRange shown_range(const danger::Axis& axis) {
  const bool both = axis.edge == danger::Edge::mirrored && axis.turned.value_or(2) >= 2;
  return {both ? -axis.last : axis.first, axis.last};
}

report::PlotAxis plot_axis_of(const danger::Axis& axis, const report::MapRange& range) {
  const report::ReadUnit read = report::read_unit(axis.name);
  return {axis.name, read.unit, range.low * read.factor, range.high * read.factor};
}

/// The snapshot's values over the plane.
report::ValueMap map_of(const Solution& solved, const report::ValueView& view,
                        const report::MapRange& x, const report::MapRange& y,
                        const report::RasterSize& size) {
  const danger::ValueTable table(solved.grid, danger::snapshot(solved, view.time));
  if (danger::view_of(solved) == danger::View::ego) {
    return report::value_map(danger::in_obstacle_frame(table, danger::View::ego), x, y,
                             size.columns, size.rows, view.others);
  }
  return report::value_map(table, x, y, size.columns, size.rows, view.others);
}

}  // namespace

double zoom_on_danger(const Solution& solved, const report::ValueView& view) {
  constexpr report::RasterSize coarse{160, 160};
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  const report::MapRange x = shown_range(axes[0]);
  const report::MapRange y = shown_range(axes[1]);
  return report::zoom_on_danger(map_of(solved, view, x, y, coarse), report::zoom_middle(x, y));
}

Result<std::string> value_picture(const Solution& solved, const report::ValueView& view) {
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  const report::MapRange all_x = shown_range(axes[0]);
  const report::MapRange all_y = shown_range(axes[1]);
  const Vec2 middle = report::zoom_middle(all_x, all_y);
  const report::MapRange x = report::zoomed(all_x, middle.x, view.zoom);
  const report::MapRange y = report::zoomed(all_y, middle.y, view.zoom);
  report::ValuePicture picture{.title = view.title,
                               .lines = {described(solved, view)},
                               .x = plot_axis_of(axes[0], x),
                               .y = plot_axis_of(axes[1], y),
                               .value_words = "V [m]",
                               .outline = report::obstacle_outline(solved.problem)};
  for (std::size_t d = 2; d < axes.size(); ++d) {
    if (axes[d].name == "course") {
      picture.course = view.others[d];
    }
  }
  const report::RasterSize size = report::raster_size(picture.x, picture.y);
  picture.map = map_of(solved, view, x, y, size);
  picture.scale = report::scale_of(picture.map.values);
  return report::value_png(picture);
}

}  // namespace saca::reach_study
