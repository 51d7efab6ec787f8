#pragma once

#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/core/vec2.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::report {

/// A value beside the exact one of the avoidance problem, where the ego's centre of mass may be.
struct BesideExact {
  std::string exact_name, other_name;
  std::vector<Vec2> outline;   ///< of the obstacle [m]; empty: none
  std::vector<double> speeds;  ///< a row of maps for each [m/s]
  double course = 0.0;         ///< of all [rad]
};

/// Three maps for each speed: the exact value, the other, and the other less the exact one (> 0:
/// too careful), left blank where the exact one is 8 m from the boundary or more.
/// @return  bytes of a PNG file; an error when there is no memory for a picture
[[nodiscard]] Result<std::string> beside_exact_png(const BesideExact& page,
                                                   const danger::ValueAt& exact,
                                                   const danger::ValueAt& other);

}  // namespace saca::report
