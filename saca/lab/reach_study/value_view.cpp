#include "saca/lab/reach_study/value_view.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>

#include "saca/lab/reach_study/value_picture.h"
#include "saca/lab/report/value_map.h"

namespace saca::reach_study {
namespace {

using danger::Solution;
using report::ReadUnit;

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

/// What is wanted of an axis, in its own unit.
Result<double> coordinate_on(const danger::Axis& axis, const AxisValue& wanted,
                             const std::string& file) {
  const double value = wanted.value / report::read_unit(axis.name).factor;
  const double least = axis.edge == danger::Edge::mirrored ? -axis.last : axis.first;
  constexpr double rounding = 1e-9;
  const double turn = axis.edge == danger::Edge::periodic ? axis.last - axis.first : 0.0;
  if (!(value >= least - turn - rounding && value <= axis.last + turn + rounding)) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("{}: {}: want {} to {}, got {}", file, axis.name, with_unit(least, axis),
                    with_unit(axis.last, axis), with_unit(value, axis))};
  }
  return value;
}

/// Coordinates from the third axis on.
Result<danger::State> other_coordinates(const std::vector<danger::Axis>& axes,
                                        const std::vector<AxisValue>& wanted,
                                        const std::string& file) {
  danger::State others{};
  for (std::size_t d = 2; d < axes.size(); ++d) {
    others[d] = usual_coordinate(axes[d]);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const AxisValue& one = wanted[i];
    if (std::any_of(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(i),
                    [&](const AxisValue& earlier) { return earlier.axis == one.axis; })) {
      return Error{Error::Code::out_of_range,
                   fmt::format("{}: {} is asked for twice", file, one.axis)};
    }
    const auto axis = std::find_if(axes.begin() + 2, axes.end(),
                                   [&](const danger::Axis& a) { return a.name == one.axis; });
    if (axis == axes.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("{}: no axis '{}' beyond the plane that is shown; the axes are {}, "
                               "the first two are the plane",
                               file, one.axis, names_of(axes))};
    }
    const auto value = coordinate_on(*axis, one, file);
    if (!value.has_value()) {
      return value.error();
    }
    others[static_cast<std::size_t>(axis - axes.begin())] = value.value();
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

}  // namespace

Result<AxisValue> axis_value(const std::string& text) {
  const std::size_t sign = text.find('=');
  AxisValue wanted{.axis = text.substr(0, sign)};
  const std::string number = sign == std::string::npos ? "" : text.substr(sign + 1);
  const auto end = std::from_chars(number.data(), number.data() + number.size(), wanted.value);
  if (wanted.axis.empty() || number.empty() || end.ec != std::errc() ||
      end.ptr != number.data() + number.size()) {
    return Error{Error::Code::malformed,
                 fmt::format("--at: want NAME=NUMBER, such as speed=12, got '{}'", text)};
  }
  return wanted;
}

Result<std::vector<AxisValue>> axis_values(std::optional<double> course,
                                           std::optional<double> speed,
                                           const std::vector<std::string>& texts) {
  std::vector<AxisValue> all;
  if (course) {
    all.push_back({"course", *course});
  }
  if (speed) {
    all.push_back({"speed", *speed});
  }
  for (const std::string& text : texts) {
    const auto one = axis_value(text);
    if (!one.has_value()) {
      return one.error();
    }
    all.push_back(one.value());
  }
  return all;
}

Result<report::ValueView> view_of(const Solution& solved, const ViewRequest& request,
                                  const std::string& file) {
  if (solved.grid.axes.size() < 2) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want a grid of at least two axes to show, got one", file)};
  }
  const auto others = other_coordinates(report::shown_axes(solved, 0.0), request.at, file);
  if (!others.has_value()) {
    return others.error();
  }
  const auto time = chosen_snapshot(solved, request.time, file);
  if (!time.has_value()) {
    return time.error();
  }
  const std::string stem = std::filesystem::path(file).stem().string();
  report::ValueView view{.title = report::problem_name(solved.problem).value_or(stem),
                         .others = others.value(),
                         .time = time.value()};
  view.zoom = request.zoom ? *request.zoom : zoom_on_danger(solved, view);
  return view;
}

std::string described(const Solution& solved, const report::ValueView& view) {
  const std::vector<danger::Axis> axes = report::shown_axes(solved, view.others[2]);
  std::string words = fmt::format("V over {} and {}", axes[0].name, axes[1].name);
  for (std::size_t d = 2; d < axes.size(); ++d) {
    words += fmt::format("{} {} {}", d == 2 ? " at" : ",", axes[d].name,
                         with_unit(view.others[d], axes[d]));
  }
  return words + fmt::format(", horizon {:.4g} s{}", solved.times[view.time],
                             solved.complete ? "" : " (stopped before its end)");
}

}  // namespace saca::reach_study
