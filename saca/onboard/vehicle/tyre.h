#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/number.h"
#include "saca/base/core/vec2.h"

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

/// The tyre's equations, for any number type `T` (`number.h`); `TyreOf` is `Tyre` or a pack of
/// them.
namespace equations {

using namespace number;

inline double per_newton(const Tyre& tyre) noexcept {
  return tyre.load_sensitivity / tyre.nominal_load;
}

template <class T, class TyreOf>
inline T peak_friction(const TyreOf& tyre, const T& load, const T& grip) noexcept {
  // The line is good near the nominal load; far above it would cross zero.
  constexpr double least = 0.5;
  return grip * max(least, 1.0 + tyre.load_sensitivity - per_newton(tyre) * load);
}

/// c[0] + c[1] x + c[2] x^2 + ..., in pairs: shorter chains than Horner's rule, so quicker.
template <class T, class C, std::size_t n>
constexpr T polynomial(const std::array<C, n>& c, const T& x) noexcept {
  if constexpr (n == 1) {
    return c[0];
  } else {
    std::array<T, (n + 1) / 2> pairs{};
    for (std::size_t i = 0; i < n / 2; ++i) {
      pairs[i] = c[2 * i] + c[2 * i + 1] * x;
    }
    if constexpr (n % 2 == 1) {
      pairs.back() = c.back();
    }
    return polynomial<T>(pairs, x * x);
  }
}

/// The magic formula's two functions as polynomials, to the digits that `T` holds: both by
/// interpolation at Chebyshev nodes.
template <class T>
struct MagicCurve {
  /// atan(w) / w over w^2 in [0, 1]: error 1e-12.
  static constexpr std::array<double, 14> arc{
      0.99999999999819672,   -0.33333333262479696,   0.19999995340385062,  -0.14285592394282527,
      0.11109428364330506,   -0.090767988766504774,  0.076142501990031214, -0.063660922360968266,
      0.050455577528416143,  -0.035267720869422438,  0.019937442836256173, -0.0082418998939968132,
      0.0021627944221564791, -0.00026660196719267423};
  /// sin(y) / y over y^2 in [0, pi^2]: error 2e-13.
  static constexpr std::array<double, 9> wave{
      0.99999999999994987,     -0.16666666666584372,    0.008333333331108153,
      -0.00019841269609467874, 2.7557307117171336e-6,   -2.505175272361866e-8,
      1.6052892947117782e-10,  -7.5849022757499094e-13, 2.4680160318832769e-15};
};

template <class T>
inline T magic_ratio(const T& shape, const T& zz) noexcept {
  // atan(z) = 2 atan(w) with w = z / (1 + root), w^2 = (root - 1) / (root + 1), at most 1.
  const T root = sqrt(1.0 + zz);
  const T w_over_z = 1.0 / (1.0 + root);
  const T y_over_z =
      2.0 * shape * w_over_z * polynomial<T>(MagicCurve<T>::arc, (root - 1.0) * w_over_z);
  return y_over_z * polynomial<T>(MagicCurve<T>::wave, zz * y_over_z * y_over_z);
}

/// B of the magic formula: the curve's slope at zero, B C D, is stiffness * load at any friction.
template <class T, class TyreOf>
inline T steepness(const TyreOf& tyre, const T& peak) noexcept {
  return tyre.stiffness / (tyre.shape * peak);
}

template <class T, class TyreOf>
inline T sliding_drag(const TyreOf& tyre, const T& sliding_squared, const T& speed_squared,
                      const T& load, const T& grip) noexcept {
  const T peak = peak_friction(tyre, load, grip);
  const T rise = steepness(tyre, peak);
  const T per_speed_squared = 1.0 / max(speed_squared, slip_speed_floor * slip_speed_floor);
  const T zz = rise * rise * (sliding_squared * per_speed_squared);
  return peak * load * rise * sqrt(per_speed_squared) * magic_ratio<T>(tyre.shape, zz);
}

template <class T, class TyreOf>
inline T slip_for(const TyreOf& tyre, const T& peak, const T& share) noexcept {
  return tan(asin(share) / tyre.shape) / steepness(tyre, peak);
}

}  // namespace equations

/// Friction coefficient of this tyre at a load: the road's grip less load sensitivity.
/// @param load  [N], >= 0
/// @param grip  friction coefficient at the nominal load [-], > 0
inline double peak_friction(const Tyre& tyre, double load, double grip) noexcept {
  return equations::peak_friction(tyre, load, grip);
}

/// sin(C atan(z)) / z, the magic formula's curve over its argument: smooth in z^2, C at 0.
///
/// @param shape  C, in (1, 2)
/// @param zz     z^2, >= 0
/// Within 3e-12 of the exact quotient times z. No branch and no call, so that the compiler can work
/// on several wheels at once.
inline double magic_ratio(double shape, double zz) noexcept {
  return equations::magic_ratio(shape, zz);
}

/// Share of the largest force that a slip gives, in [0, 1].
/// @param slip  size of the sliding velocity over speed [-], >= 0
/// @param peak  peak_friction(...) [-], > 0
[[nodiscard]] double force_share(const Tyre& tyre, double peak, double slip);

/// The smallest slip that gives a share of the largest force; the inverse of `force_share` up to
/// the peak.
/// @param share  in [0, 1]
[[nodiscard]] double slip_for(const Tyre& tyre, double peak, double share);

/// Force of the road against a sliding wheel, over its sliding velocity [N s/m], >= 0: the force is
/// minus this times the velocity, and never larger than peak_friction * load.
///
/// @param sliding_squared  of the contact patch over ground [m^2/s^2], >= 0
/// @param speed_squared    of the wheel centre over ground [m^2/s^2], >= 0
/// @param load             [N], >= 0
/// @param grip             friction coefficient at the nominal load [-], > 0
///
/// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed., ch. 4 (magic formula), here with one
/// curve for both directions.
inline double sliding_drag(const Tyre& tyre, double sliding_squared, double speed_squared,
                           double load, double grip) noexcept {
  return equations::sliding_drag(tyre, sliding_squared, speed_squared, load, grip);
}

/// The same as a force, expressed in T [N].
/// @param v_slip_T  velocity of the contact patch over ground [m/s]
/// @param speed     of the wheel centre over ground [m/s], >= 0
inline Vec2 tyre_force(const Tyre& tyre, Vec2 v_slip_T, double speed, double load,
                       double grip) noexcept {
  return -sliding_drag(tyre, dot(v_slip_T, v_slip_T), speed * speed, load, grip) * v_slip_T;
}

}  // namespace saca::vehicle
