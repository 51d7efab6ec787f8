#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/report/value_json.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::reach_study {

/// A coordinate beyond the plane that is asked for.
struct AxisValue {
  std::string axis;
  double value = 0.0;  ///< in the unit that is read (report::read_unit)
  bool operator==(const AxisValue&) const = default;
};

/// From "NAME=NUMBER", such as "speed=12".
/// @return  Error::Code::malformed, naming what is wanted and what came
[[nodiscard]] Result<AxisValue> axis_value(const std::string& text);

/// Likewise of several, after the course [deg] and the speed [m/s], where these are given.
[[nodiscard]] Result<std::vector<AxisValue>> axis_values(std::optional<double> course,
                                                         std::optional<double> speed,
                                                         const std::vector<std::string>& texts);

/// What of a solution is to be shown.
struct ViewRequest {
  std::vector<AxisValue> at;   ///< other axes: at 0 where they have it inside, else in the middle
  std::optional<double> time;  ///< of a snapshot [s]; nullopt: the last
  std::optional<double> zoom;  ///< in [1, 8]; nullopt: so that all danger can be seen
};

/// @param file  of the solution: named by messages, and by the title where the case has no name
/// @return      Error::Code::malformed: the grid has one axis; out_of_range, naming the file, what
///              is wanted and what came: there is no such axis, coordinate or snapshot
[[nodiscard]] Result<report::ValueView> view_of(const danger::Solution& solved,
                                                const ViewRequest& request,
                                                const std::string& file);

/// "V over x and y at course 0 deg, speed 12 m/s, horizon 4 s"
[[nodiscard]] std::string described(const danger::Solution& solved, const report::ValueView& view);

}  // namespace saca::reach_study
