#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/base/core/vec2.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/record_page.h"
#include "saca/lab/report/value_json.h"
#include "saca/lab/report/value_map.h"
#include "saca/lab/report/value_png.h"
#include "saca/thinking/danger/obstacle_frame.h"
#include "saca/thinking/danger/value_file.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using danger::Solution;
using report::ReadUnit;

struct ReachShowOptions {
  std::string file;
  std::string output;
  std::optional<double> speed;   // [m/s]
  std::optional<double> course;  // [deg]
  std::optional<double> time;    // [s]
  std::optional<double> zoom;    // none: so that the danger can be seen
  std::vector<std::string> at;   // name=value, in the unit that is read
};

/// A coordinate beyond the plane that was asked for.
struct Wish {
  std::string axis;
  double value = 0.0;  // in the unit that is read
};

Result<Wish> parsed_wish(const std::string& text) {
  const std::size_t sign = text.find('=');
  Wish wish{.axis = text.substr(0, sign)};
  const std::string number = sign == std::string::npos ? "" : text.substr(sign + 1);
  const auto end = std::from_chars(number.data(), number.data() + number.size(), wish.value);
  if (wish.axis.empty() || number.empty() || end.ec != std::errc() ||
      end.ptr != number.data() + number.size()) {
    return Error{Error::Code::malformed,
                 fmt::format("--at: want NAME=NUMBER, such as speed=12, got '{}'", text)};
  }
  return wish;
}

Result<std::vector<Wish>> wishes_of(const ReachShowOptions& options) {
  std::vector<Wish> wishes;
  if (options.course) {
    wishes.push_back({"course", *options.course});
  }
  if (options.speed) {
    wishes.push_back({"speed", *options.speed});
  }
  for (const std::string& text : options.at) {
    const auto wish = parsed_wish(text);
    if (!wish.has_value()) {
      return wish.error();
    }
    wishes.push_back(wish.value());
  }
  return wishes;
}

std::string with_unit(double value, const danger::Axis& axis) {
  const ReadUnit read = report::read_unit(axis.name);
  return fmt::format("{:.4g}{}{}", value * read.factor, read.unit.empty() ? "" : " ", read.unit);
}

/// 0 where the axis has it inside, else its middle.
double usual_coordinate(const danger::Axis& axis) {
  const bool around_zero = axis.first < 0.0 && axis.last > 0.0;
  return around_zero || axis.edge == danger::Edge::mirrored ? 0.0 : 0.5 * (axis.first + axis.last);
}

std::string names_of(const std::vector<danger::Axis>& axes) {
  std::vector<std::string> names;
  names.reserve(axes.size());
  for (const danger::Axis& axis : axes) {
    names.push_back(axis.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Coordinates from the third axis on.
Result<danger::State> other_coordinates(const std::vector<danger::Axis>& axes,
                                        const std::vector<Wish>& wishes, const std::string& file) {
  danger::State others{};
  for (std::size_t d = 2; d < axes.size(); ++d) {
    others[d] = usual_coordinate(axes[d]);
  }
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Wish& wish = wishes[i];
    if (std::any_of(wishes.begin(), wishes.begin() + static_cast<std::ptrdiff_t>(i),
                    [&](const Wish& earlier) { return earlier.axis == wish.axis; })) {
      return Error{Error::Code::out_of_range,
                   fmt::format("{}: {} is asked for twice", file, wish.axis)};
    }
    const auto axis = std::find_if(axes.begin() + 2, axes.end(),
                                   [&](const danger::Axis& a) { return a.name == wish.axis; });
    if (axis == axes.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("{}: no axis '{}' beyond the plane that is shown; the axes are {}, "
                               "the first two are the plane",
                               file, wish.axis, names_of(axes))};
    }
    const double value = wish.value / report::read_unit(axis->name).factor;
    const double least = axis->edge == danger::Edge::mirrored ? -axis->last : axis->first;
    constexpr double rounding = 1e-9;
    const double turn = axis->edge == danger::Edge::periodic ? axis->last - axis->first : 0.0;
    if (!(value >= least - turn - rounding && value <= axis->last + turn + rounding)) {
      return Error{
          Error::Code::out_of_range,
          fmt::format("{}: {}: want {} to {}, got {}", file, axis->name, with_unit(least, *axis),
                      with_unit(axis->last, *axis), with_unit(value, *axis))};
    }
    others[static_cast<std::size_t>(axis - axes.begin())] = value;
  }
  return others;
}

Result<std::size_t> chosen_snapshot(const Solution& solved, std::optional<double> time,
                                    const std::string& file) {
  if (!time) {
    return solved.times.size() - 1;
  }
  const std::size_t nearest = danger::nearest_snapshot(solved, *time);
  constexpr double same = 1e-3;  // [s]: what is typed is rounded
  if (!(std::abs(solved.times[nearest] - *time) <= same)) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: --time-s: want one of {}, got {}", file,
                             fmt::join(solved.times, ", "), *time)};
  }
  return nearest;
}

/// The whole axis; a mirrored one to both sides, where its mirror turns no axis of the plane.
report::MapRange shown_range(const danger::Axis& axis) {
  const bool both = axis.edge == danger::Edge::mirrored && axis.turned.value_or(2) >= 2;
  return {both ? -axis.last : axis.first, axis.last};
}

report::PlotAxis plot_axis_of(const danger::Axis& axis, const report::MapRange& range) {
  const ReadUnit read = report::read_unit(axis.name);
  return {axis.name, read.unit, range.low * read.factor, range.high * read.factor};
}

/// "V over x and y at course 0 deg, speed 12 m/s, horizon 4 s"
std::string what_is_shown(const Solution& solved, const report::ValueView& view) {
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  std::string words = fmt::format("V over {} and {}", axes[0].name, axes[1].name);
  for (std::size_t d = 2; d < axes.size(); ++d) {
    words += fmt::format("{} {} {}", d == 2 ? " at" : ",", axes[d].name,
                         with_unit(view.others[d], axes[d]));
  }
  return words + fmt::format(", horizon {:.4g} s{}", solved.times[view.time],
                             solved.complete ? "" : " (stopped before its end)");
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

double usual_zoom(const Solution& solved, const report::ValueView& view) {
  constexpr report::RasterSize coarse{160, 160};
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  const report::MapRange x = shown_range(axes[0]);
  const report::MapRange y = shown_range(axes[1]);
  return report::zoom_on_danger(map_of(solved, view, x, y, coarse), report::zoom_middle(x, y));
}

Result<std::string> png_of(const Solution& solved, const report::ValueView& view) {
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  const report::MapRange all_x = shown_range(axes[0]);
  const report::MapRange all_y = shown_range(axes[1]);
  const Vec2 middle = report::zoom_middle(all_x, all_y);
  const report::MapRange x = report::zoomed(all_x, middle.x, view.zoom);
  const report::MapRange y = report::zoomed(all_y, middle.y, view.zoom);
  report::ValuePicture picture{.title = view.title,
                               .lines = {what_is_shown(solved, view)},
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

int show(const ReachShowOptions& options) {
  if (!is_png_or_html(options.output)) {
    return wrong_command_line;
  }
  const auto wishes = wishes_of(options);
  if (!wishes.has_value()) {
    complain(wishes.error().message);
    return wrong_command_line;
  }
  const auto read = danger::read_solved(options.file);
  if (!read.has_value()) {
    return refused(read.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const Solution& solved = read.value();
  if (solved.grid.axes.size() < 2) {
    complain(fmt::format("{}: want a grid of at least two axes to show, got one", options.file));
    return bad_input;
  }
  const auto others =
      other_coordinates(report::shown_axes(solved, 0.0), wishes.value(), options.file);
  const auto time = chosen_snapshot(solved, options.time, options.file);
  if (!others.has_value() || !time.has_value()) {
    return refused(others.has_value() ? time.error() : others.error());
  }
  const std::string stem = fs::path(options.file).stem().string();
  report::ValueView view{.title = report::problem_name(solved.problem).value_or(stem),
                         .others = others.value(),
                         .time = time.value()};
  view.zoom = options.zoom ? *options.zoom : usual_zoom(solved, view);
  const auto made = fs::path(options.output).extension() == ".png"
                        ? png_of(solved, view)
                        : report::value_report(report::value_json(solved, view));
  if (!made.has_value()) {
    return refused(made.error());
  }
  if (const auto problem = long_work::write_output(options.output, made.value())) {
    return refused(*problem);
  }
  app::print("{}: {}\n", options.output, what_is_shown(solved, view));
  return success;
}

}  // namespace

void add_reach_show(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "show", "A solved value over x and y, or its first two coordinates, as PNG or HTML");
  const auto options = std::make_shared<ReachShowOptions>();
  command->add_option("FILE", options->file, "What saca reach solve left")->required();
  command
      ->add_option("--output", options->output, "A picture (.png), or a page with sliders (.html)")
      ->required();
  command->add_option("--speed-mps", options->speed, "Default: the middle of the grid's");
  command->add_option("--course-deg", options->course, "Default: 0");
  command->add_option("--time-s", options->time,
                      "A horizon that the file has; default: the longest");
  command
      ->add_option("--zoom", options->zoom,
                   "Into the middle of the plane; 1: all of it; default: shows all danger")
      ->check(within(1.0, 8.0));
  command->add_option("--at", options->at,
                      "NAME=VALUE of another axis; angles in deg, else in SI units");
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace saca::app
