#include "saca/manoeuvre/unknown.h"

#include <algorithm>

namespace saca::manoeuvre {

Unknown draw(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  const auto by = [&](double sd) { return sd * std::clamp(normal(rng), -3.0, 3.0); };
  Unknown unknown;  // in the order of its fields: the same seed gives the same draws
  unknown.grip += by(unknown_sd.grip);
  unknown.mass += by(unknown_sd.mass);
  unknown.yaw_inertia += by(unknown_sd.yaw_inertia);
  unknown.stiffness += by(unknown_sd.stiffness);
  unknown.lag += by(unknown_sd.lag);
  unknown.speed += by(unknown_sd.speed);
  return unknown;
}

vehicle::Vehicle real_car(const Car& car, const Unknown& unknown) {
  constexpr double least_lag = 0.005;  // [s]
  vehicle::Vehicle real = car;
  real.mass *= unknown.mass;
  real.yaw_inertia *= unknown.yaw_inertia;
  real.tyre.stiffness *= unknown.stiffness;
  // Stiffer than steps of 1 ms resolve is not drawn.
  real.tyre.stiffness *= std::min(1.0, vehicle::longest_step(real) / vehicle::usual_step);
  real.steering_lag = std::max(least_lag, real.steering_lag + unknown.lag);
  real.brake_lag = std::max(least_lag, real.brake_lag + unknown.lag);
  return real;
}

}  // namespace saca::manoeuvre
