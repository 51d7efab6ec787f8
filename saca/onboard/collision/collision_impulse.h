#pragma once

#include "saca/base/core/vec2.h"
#include "saca/base/world/footprint.h"

namespace saca::collision {

/// A rigid body in the plane just before an impact. Inverses, so that 0 is a body that nothing
/// moves.
struct ImpactBody {
  double inverse_mass = 0.0;         ///< [1/kg], >= 0
  double inverse_yaw_inertia = 0.0;  ///< about the centre of mass [1/(kg m^2)], >= 0
  Vec2 p_W;                          ///< centre of mass [m]
  Vec2 v_W;                          ///< of the centre of mass [m/s]
  double yaw_rate = 0.0;             ///< [rad/s]
};

/// A body whose mass is spread evenly over its footprint: m (l^2 + w^2) / 12 for a box, / 16 for an
/// ellipse. An assumption: real cars lie some 25 % below it.
[[nodiscard]] ImpactBody free_body(double mass, const world::Footprint& footprint);

/// How two surfaces part.
struct ImpactLaw {
  double restitution = 0.0;  ///< impulse of the parting over that of the approach, in [0, 1]
  double friction = 0.0;     ///< between the bodies [-], >= 0
};

struct CollisionImpulse {
  Vec2 impulse_W;          ///< on b; a receives its opposite [N s]
  double a_delta_v = 0.0;  ///< change of the velocity of a's centre of mass [m/s], >= 0
  double b_delta_v = 0.0;  ///< likewise of b
  double a_spin = 0.0;     ///< change of a's yaw rate [rad/s]
  double b_spin = 0.0;     ///< likewise of b
};

/// Instant planar impact of `a` and `b` at one point.
///
/// @param p_W  the point
/// @param n_W  unit normal there, from a to b
/// @return     zero when the bodies do not approach each other at the point
/// @throws ContractViolation  if a number is not finite or out of range, or n_W no unit vector
///
/// First the approach is stopped, with Coulomb friction against the sliding that remains; then the
/// same impulse acts once more, times the restitution (Poisson). Momentum is conserved and energy
/// never created, whatever the geometry. Equations as in Brach, Analysis of planar vehicle
/// collisions using equations of impulse and momentum, Accident Analysis and Prevention 15 (1983),
/// without his impact moment.
[[nodiscard]] CollisionImpulse collision_impulse(const ImpactBody& a, const ImpactBody& b, Vec2 p_W,
                                                 Vec2 n_W, const ImpactLaw& law);

/// Velocity of the point of b at p_W, minus that of the point of a there [m/s].
[[nodiscard]] Vec2 relative_velocity_at(const ImpactBody& a, const ImpactBody& b, Vec2 p_W);

}  // namespace saca::collision
