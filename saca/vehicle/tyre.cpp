#include "saca/vehicle/tyre.h"

#include <algorithm>
#include <cmath>

namespace saca::vehicle {
namespace {

// B of the magic formula: the slope at zero, B C D, is stiffness * load whatever the friction.
double steepness(const Tyre& tyre, double peak) {
  return tyre.stiffness / (tyre.shape * peak);
}

}  // namespace

double peak_friction(const Tyre& tyre, double load, double grip) {
  // The line is good near the nominal load; far above it would cross zero.
  constexpr double least = 0.5;
  return grip * std::max(least, 1.0 - tyre.load_sensitivity * (load / tyre.nominal_load - 1.0));
}

double force_share(const Tyre& tyre, double peak, double slip) {
  return std::sin(tyre.shape * std::atan(steepness(tyre, peak) * slip));
}

double slip_for(const Tyre& tyre, double peak, double share) {
  return std::tan(std::asin(share) / tyre.shape) / steepness(tyre, peak);
}

Vec2 tyre_force(const Tyre& tyre, Vec2 v_slip_T, double speed, double load, double grip) {
  const double sliding = std::sqrt(dot(v_slip_T, v_slip_T));
  const double divisor = std::max(speed, slip_speed_floor);
  const double slip = sliding / divisor;
  if (slip < 1e-9) {  // the limit of share / slip, without 0 / 0
    return -(tyre.stiffness * load / divisor) * v_slip_T;
  }
  const double peak = peak_friction(tyre, load, grip);
  return -(peak * load * force_share(tyre, peak, slip) / sliding) * v_slip_T;
}

}  // namespace saca::vehicle
