#pragma once

#include "saca/core/vec2.h"

namespace saca::vehicle {

/// A tyre that slides as easily to the side as along: one curve of force over the size of slip.
///
/// Wheel frame T (ISO 8855): x forward, y left. The force points against the sliding velocity of
/// the contact patch; its size follows the magic formula D sin(C atan(B s)).
struct Tyre {
  double stiffness;  ///< slope of force over load at zero slip [-], > 0
  double shape;      ///< C of the magic formula [-], in (1, 2): above 1 it falls after the peak
  double load_sensitivity;  ///< share of friction lost when the load doubles [-], in [0, 0.3]
  double nominal_load;      ///< load at which the road's grip holds exactly [N], > 0
};

/// Below this speed of the wheel over ground slip is sliding velocity over this speed [m/s].
///
/// Slip is otherwise sliding velocity over speed, which has no limit at rest and makes the wheel's
/// spin too stiff for steps of 1 ms. Softer than a real tyre below it; the same above it.
constexpr double slip_speed_floor = 4.0;

/// Friction coefficient of this tyre at a load: the road's grip less load sensitivity.
/// @param load  [N], >= 0
/// @param grip  friction coefficient at the nominal load [-], > 0
[[nodiscard]] double peak_friction(const Tyre& tyre, double load, double grip);

/// Share of the largest force that a slip gives, in [0, 1].
/// @param slip  size of the sliding velocity over speed [-], >= 0
/// @param peak  peak_friction(...) [-], > 0
[[nodiscard]] double force_share(const Tyre& tyre, double peak, double slip);

/// The smallest slip that gives a share of the largest force; the inverse of `force_share` up to
/// the peak.
/// @param share  in [0, 1]
[[nodiscard]] double slip_for(const Tyre& tyre, double peak, double share);

/// Force of the road on the wheel, expressed in T [N]; never larger than peak_friction * load.
///
/// @param v_slip_T  velocity of the contact patch over ground [m/s]
/// @param speed     of the wheel centre over ground [m/s], >= 0
/// @param load      [N], >= 0
/// @param grip      friction coefficient at the nominal load [-], > 0
///
/// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed., ch. 4 (magic formula), here with one
/// curve for both directions.
[[nodiscard]] Vec2 tyre_force(const Tyre& tyre, Vec2 v_slip_T, double speed, double load,
                              double grip);

}  // namespace saca::vehicle
