#include "saca/onboard/collision/collision_impulse.h"

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::collision {
namespace {

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

Vec2 velocity_at(const ImpactBody& body, Vec2 p_W) {
  const Vec2 arm = p_W - body.p_W;
  return body.v_W + body.yaw_rate * Vec2{-arm.y, arm.x};
}

// Relative velocity along `out` that a unit impulse along `in` brings about [1/kg].
double give(const ImpactBody& a, const ImpactBody& b, Vec2 p_W, Vec2 in, Vec2 out) {
  const auto of = [&](const ImpactBody& body) {
    const Vec2 arm = p_W - body.p_W;
    return body.inverse_mass * dot(in, out) +
           body.inverse_yaw_inertia * cross(arm, in) * cross(arm, out);
  };
  return of(a) + of(b);
}

// Impulse on b, in normal and tangential parts.
struct Impulse {
  double normal = 0.0;
  double tangential = 0.0;
};

// The impulse that ends the approach, vn = 0, with friction opposed to the sliding that remains.
// Both the sticking and the sliding case then only take energy: J . v_after <= 0, and
// J . v_before = J . v_after - J K J.
Impulse stop(double vn, double vt, double k_nn, double k_nt, double k_tt, double friction) {
  const double determinant = k_nn * k_tt - k_nt * k_nt;
  if (determinant > 0.0) {
    const Impulse stick{(-vn * k_tt + vt * k_nt) / determinant,
                        (-vt * k_nn + vn * k_nt) / determinant};
    if (stick.normal >= 0.0 && std::abs(stick.tangential) <= friction * stick.normal) {
      return stick;
    }
  }
  const double forward = vt >= 0.0 ? 1.0 : -1.0;
  for (const double sliding : {forward, -forward}) {
    const double k = k_nn - friction * sliding * k_nt;
    if (k <= 0.0) {
      continue;
    }
    const double normal = -vn / k;
    const double remains = vt + normal * (k_nt - friction * sliding * k_tt);
    if (sliding * remains >= 0.0) {
      return {normal, -friction * sliding * normal};
    }
  }
  return {-vn / k_nn, 0.0};  // no consistent sliding (friction jams): without friction
}

}  // namespace

ImpactBody free_body(double mass, const world::Footprint& footprint) {
  expects(mass > 0.0 && std::isfinite(mass), "mass > 0");
  expects(footprint.length > 0.0 && footprint.width > 0.0, "length and width > 0");
  const double square = footprint.length * footprint.length + footprint.width * footprint.width;
  const double divisor = footprint.shape == world::Shape::box ? 12.0 : 16.0;
  ImpactBody body;
  body.inverse_mass = 1.0 / mass;
  body.inverse_yaw_inertia = divisor / (mass * square);
  return body;
}

Vec2 relative_velocity_at(const ImpactBody& a, const ImpactBody& b, Vec2 p_W) {
  return velocity_at(b, p_W) - velocity_at(a, p_W);
}

CollisionImpulse collision_impulse(const ImpactBody& a, const ImpactBody& b, Vec2 p_W, Vec2 n_W,
                                   const ImpactLaw& law) {
  for (const ImpactBody* body : {&a, &b}) {
    expects(body->inverse_mass >= 0.0 && body->inverse_yaw_inertia >= 0.0, "inverses >= 0");
    expects(is_finite(body->p_W) && is_finite(body->v_W) && std::isfinite(body->yaw_rate),
            "the body's motion is finite");
  }
  expects(a.inverse_mass + b.inverse_mass > 0.0, "one of the bodies can move");
  expects(is_finite(p_W), "p_W is finite");
  expects(std::abs(norm(n_W) - 1.0) < 1e-6, "n_W is a unit vector");
  expects(law.restitution >= 0.0 && law.restitution <= 1.0, "restitution in [0, 1]");
  expects(law.friction >= 0.0, "friction >= 0");

  const Vec2 t_W{-n_W.y, n_W.x};
  const Vec2 v_W = relative_velocity_at(a, b, p_W);
  const double vn = dot(v_W, n_W);
  if (vn >= 0.0) {
    return {};
  }
  const Impulse stopping = stop(vn, dot(v_W, t_W), give(a, b, p_W, n_W, n_W),
                                give(a, b, p_W, n_W, t_W), give(a, b, p_W, t_W, t_W), law.friction);
  const Vec2 impulse_W =
      (1.0 + law.restitution) * (stopping.normal * n_W + stopping.tangential * t_W);
  const double size = norm(impulse_W);
  return {.impulse_W = impulse_W,
          .a_delta_v = size * a.inverse_mass,
          .b_delta_v = size * b.inverse_mass,
          .a_spin = -a.inverse_yaw_inertia * cross(p_W - a.p_W, impulse_W),
          .b_spin = b.inverse_yaw_inertia * cross(p_W - b.p_W, impulse_W)};
}

}  // namespace saca::collision
