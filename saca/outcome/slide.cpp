#include "saca/outcome/slide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/core/contract.h"
#include "saca/vehicle/vehicle.h"

namespace saca::outcome {
namespace {

constexpr double pose_step = 0.01;    // [s]
constexpr double resting = 0.05;      // of all wheels [m/s]
constexpr double longest_slide = 60;  // [s]: 25 m/s at a grip of 0.05 rest after 51

struct Wheel {
  Vec2 p_B;
  double deceleration = 0.0;  ///< of the whole body by this wheel [m/s^2]
};
using Wheels = std::array<Wheel, 4>;

// The loads balance about the body's origin, which is its centre of mass.
Wheels wheels(const world::Footprint& footprint, double grip) {
  const Vec2 half = half_axes(footprint);
  const Vec2 reach{0.6 * half.x, 0.8 * half.y};
  const double front_share = std::clamp(0.5 * (reach.x - footprint.centre_x) / reach.x, 0.0, 1.0);
  Wheels all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool front = i < 2;
    all[i].p_B = {footprint.centre_x + (front ? reach.x : -reach.x),
                  i % 2 == 0 ? reach.y : -reach.y};
    all[i].deceleration = 0.5 * (front ? front_share : 1.0 - front_share) * grip * vehicle::gravity;
  }
  return all;
}

// Of the body's origin; also their rates of change.
struct Motion {
  Vec2 p_W;
  double yaw = 0.0;
  Vec2 v_W;
  double yaw_rate = 0.0;
};

Motion advanced(const Motion& from, const Motion& rate, double dt) {
  return {from.p_W + dt * rate.p_W, from.yaw + dt * rate.yaw, from.v_W + dt * rate.v_W,
          from.yaw_rate + dt * rate.yaw_rate};
}

class Sliding {
 public:
  Sliding(const Wheels& wheels, double mass_over_inertia)
      : wheels_(wheels), mass_over_inertia_(mass_over_inertia) {}

  [[nodiscard]] Motion rate(const Motion& now) const {
    Motion rate{now.v_W, now.yaw_rate, {}, 0.0};
    const double c = std::cos(now.yaw);
    const double s = std::sin(now.yaw);
    for (const Wheel& wheel : wheels_) {
      const Vec2 arm_W{c * wheel.p_B.x - s * wheel.p_B.y, s * wheel.p_B.x + c * wheel.p_B.y};
      const Vec2 v_W = now.v_W + now.yaw_rate * Vec2{-arm_W.y, arm_W.x};
      const double speed = std::sqrt(dot(v_W, v_W));
      const Vec2 a_W = (-wheel.deceleration / std::max(speed, resting)) * v_W;
      rate.v_W = rate.v_W + a_W;
      rate.yaw_rate += mass_over_inertia_ * (arm_W.x * a_W.y - arm_W.y * a_W.x);
    }
    return rate;
  }

  [[nodiscard]] Motion step(const Motion& now, double dt) const {
    const Motion k1 = rate(now);
    const Motion k2 = rate(advanced(now, k1, 0.5 * dt));
    const Motion k3 = rate(advanced(now, k2, 0.5 * dt));
    const Motion k4 = rate(advanced(now, k3, dt));
    Motion next = advanced(now, k1, dt / 6.0);
    next = advanced(next, k2, dt / 3.0);
    next = advanced(next, k3, dt / 3.0);
    return advanced(next, k4, dt / 6.0);
  }

  [[nodiscard]] bool rests(const Motion& now) const {
    const double reach = norm(wheels_[0].p_B - wheels_[3].p_B);
    return norm(now.v_W) + std::abs(now.yaw_rate) * 0.5 * reach < resting;
  }

 private:
  Wheels wheels_;
  double mass_over_inertia_;
};

}  // namespace

manoeuvre::EgoMotion slide(const world::Footprint& footprint, const ImpactBody& body,
                           const Pose& X_WB, double start, double grip, int steps_per_pose) {
  expects(is_finite(X_WB) && is_finite(body.v_W) && std::isfinite(body.yaw_rate) &&
              std::isfinite(start),
          "the body's motion is finite");
  expects(grip > 0.0 && std::isfinite(grip), "grip > 0");
  expects(footprint.length > 0.0 && std::isfinite(footprint.centre_x), "length > 0");
  expects(steps_per_pose >= 1, "steps_per_pose >= 1");
  manoeuvre::EgoMotion motion;
  motion.track.start = start;
  motion.track.step = pose_step;
  motion.ended = true;
  const auto note = [&](const Motion& now, bool rests) {
    motion.track.X_WA.push_back({now.p_W, wrap_angle(now.yaw)});
    motion.v_B.push_back(rests ? Vec2{} : rotated(now.v_W, -now.yaw));
    motion.yaw_rate.push_back(rests ? 0.0 : now.yaw_rate);
  };
  Motion now{X_WB.p, X_WB.yaw, body.v_W, body.yaw_rate};
  const bool moves = body.inverse_mass > 0.0 && body.inverse_yaw_inertia > 0.0;
  const Sliding sliding(wheels(footprint, grip),
                        moves ? body.inverse_yaw_inertia / body.inverse_mass : 0.0);
  bool rests = !moves || sliding.rests(now);
  note(now, rests);
  const double dt = pose_step / steps_per_pose;
  for (int pose = 1; !rests && pose * pose_step < longest_slide; ++pose) {
    for (int i = 0; i < steps_per_pose && !rests; ++i) {
      now = sliding.step(now, dt);
      rests = sliding.rests(now);
    }
    note(now, rests);
  }
  return motion;
}

}  // namespace saca::outcome
