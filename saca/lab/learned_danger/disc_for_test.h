#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/point_mass.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::learned_danger {

/// A disc that cannot steer before a disc at rest: V_h has a closed form, that of braking.
struct DiscBeforeDisc {
  PointMass problem{.system = {.grip = 0.8, .tightest_curvature = 1e-9, .drive_share = 0.4},
                    .ego = {world::Shape::ellipse, 2.0, 2.0},
                    .obstacle = {world::Shape::ellipse, 3.0, 3.0}};
  static constexpr double touching = 2.5;  ///< distance of the centres [m]

  /// @param ahead, left  of the obstacle from the ego, along its course [m]
  [[nodiscard]] double value(double ahead, double left, double speed) const {
    const double way = speed * speed / (2.0 * problem.system.grip * vehicle::gravity);
    const double nearest = std::clamp(ahead, 0.0, way);
    return touching - std::hypot(ahead - nearest, left);
  }
  [[nodiscard]] double value(const danger::State& at) const {
    const double c = std::cos(at[2]);
    const double s = std::sin(at[2]);
    return value(-(c * at[0] + s * at[1]), s * at[0] - c * at[1], at[3]);
  }
  /// Of what the networks see of it, which must not be beyond 60 m.
  [[nodiscard]] double value(const float* inputs) const {
    const auto number = [&](std::size_t i) { return static_cast<double>(inputs[i]); };
    return value(30.0 * number(9), 15.0 * number(10), 20.0 * number(0));
  }
  [[nodiscard]] danger::ValueAt exact() const {
    return [this](const danger::State& at) { return danger::LookupResult{value(at), 0.0, true}; };
  }
};

}  // namespace saca::learned_danger
