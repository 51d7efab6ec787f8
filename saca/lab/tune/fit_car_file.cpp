#include "saca/lab/tune/fit_car_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saca/base/core/csv.h"
#include "saca/lab/prepare/vehicle_file.h"

namespace saca::tune {
namespace {

// The key of `key = value`, the name in `[name]`; empty for other lines.
std::string_view key_of(std::string_view line) {
  return trimmed(line.substr(0, std::min(line.find('='), line.size())));
}

std::string_view header_of(std::string_view line) {
  const std::string_view text = trimmed(line.substr(0, line.find('#')));
  return text.starts_with('[') && text.ends_with(']') ? trimmed(text.substr(1, text.size() - 2))
                                                      : std::string_view{};
}

std::string fitted_line(const FittedParameter& one, std::string_view logs) {
  return fmt::format("{} = {:.6g}  # fitted to {}: {:.4g} to {:.4g} (95 %); before: {:g}", one.key,
                     one.value, logs, one.low, one.high, one.base);
}

// Six digits in the file; the same keys for the same car.
bool is_same(const vehicle::Vehicle& car, const vehicle::Vehicle& wanted) {
  return car.tyre.stiffness == wanted.tyre.stiffness && car.tyre.shape == wanted.tyre.shape &&
         car.yaw_inertia == wanted.yaw_inertia && car.drag_area == wanted.drag_area &&
         car.steering_lag == wanted.steering_lag && car.brake_dead_time == wanted.brake_dead_time &&
         car.brake_lag == wanted.brake_lag;
}

}  // namespace

Result<std::string> fitted_car_file(std::string_view base, std::string_view source,
                                    std::string_view logs, const VehicleFit& fit) {
  // A name with a line end in it would end the comment.
  std::string names(logs);
  std::replace_if(
      names.begin(), names.end(), [](char c) { return c < ' ' || c == '\x7f'; }, '?');
  std::string text;
  std::string_view section;
  for (std::string_view rest = base; !rest.empty();) {
    const std::string_view line = cut_line(rest);
    if (const std::string_view header = header_of(line); !header.empty()) {
      section = header;
    }
    const auto found =
        std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const FittedParameter& one) {
          return one.determined && one.section == section && one.key == key_of(line);
        });
    text += found != fit.parameters.end() ? fitted_line(*found, names) : std::string(line);
    text += '\n';
  }
  const Result<vehicle::Vehicle> read = prepare::parse_vehicle(text, source);
  if (!read.has_value()) {
    return read.error();
  }
  if (!is_same(read.value(), fit.car)) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want each fitted key as `key = value` on a line of its own below "
                             "its [table]",
                             source)};
  }
  return text;
}

}  // namespace saca::tune
