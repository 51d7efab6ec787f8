#include "saca/onboard/manoeuvre/parameter_perturbation.h"

#include <algorithm>

namespace saca::manoeuvre {

ParameterPerturbation draw(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  const auto by = [&](double sd) { return sd * std::clamp(normal(rng), -3.0, 3.0); };
  ParameterPerturbation
      perturbation;  // in the order of its fields: the same seed gives the same draws
  perturbation.grip += by(perturbation_sd.grip);
  perturbation.mass += by(perturbation_sd.mass);
  perturbation.yaw_inertia += by(perturbation_sd.yaw_inertia);
  perturbation.stiffness += by(perturbation_sd.stiffness);
  perturbation.lag += by(perturbation_sd.lag);
  perturbation.speed += by(perturbation_sd.speed);
  return perturbation;
}

vehicle::Vehicle real_car(const Car& car, const ParameterPerturbation& perturbation) {
  constexpr double least_lag = 0.005;  // [s]
  vehicle::Vehicle real = car;
  real.mass *= perturbation.mass;
  real.yaw_inertia *= perturbation.yaw_inertia;
  real.tyre.stiffness *= perturbation.stiffness;
  // Stiffer than steps of 1 ms resolve is not drawn.
  real.tyre.stiffness *= std::min(1.0, vehicle::longest_step(real) / vehicle::usual_step);
  real.steering_lag = std::max(least_lag, real.steering_lag + perturbation.lag);
  real.brake_lag = std::max(least_lag, real.brake_lag + perturbation.lag);
  return real;
}

}  // namespace saca::manoeuvre
