#pragma once

#include <random>

#include "saca/onboard/manoeuvre/car.h"

namespace saca::manoeuvre {

/// What a controller does not know: how the real car, road and start differ from what it takes them
/// for. Factors but for the last two.
struct ParameterPerturbation {
  double grip = 1.0;         ///< of the road's friction coefficient [-]
  double mass = 1.0;         ///< [-]
  double yaw_inertia = 1.0;  ///< [-]
  double stiffness = 1.0;    ///< of the tyres [-]
  double lag = 0.0;          ///< more than known, of steering and brakes [s]
  double speed = 0.0;        ///< likewise, at the start [m/s]
};

/// Standard deviations of what manoeuvres must bear; draws beyond three of them are taken as three.
constexpr ParameterPerturbation perturbation_sd{.grip = 0.06,
                                                .mass = 0.03,
                                                .yaw_inertia = 0.04,
                                                .stiffness = 0.10,
                                                .lag = 0.010,
                                                .speed = 0.15};

/// One draw, each quantity by itself from a normal distribution.
[[nodiscard]] ParameterPerturbation draw(std::mt19937_64& rng);

/// The real car, where `car` is what the controller knows; never too stiff for `usual_step`.
[[nodiscard]] vehicle::Vehicle real_car(const Car& car, const ParameterPerturbation& perturbation);

}  // namespace saca::manoeuvre
