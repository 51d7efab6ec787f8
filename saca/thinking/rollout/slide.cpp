#include "saca/thinking/rollout/slide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::rollout {
namespace {

constexpr double resting = 0.05;      // of all wheels [m/s]
constexpr double full_grip = 10.0;    // [m/s^2]: what a step takes of the speed at most
constexpr double most_turned = 0.2;   // in a part of a step [rad]: beyond 2.8 energy is gained, and
                                      // the course errs by 1e-2 of the fifth power of it
constexpr double most_parts = 100;    // of a step, however fast a body spins
constexpr double longest_slide = 60;  // [s]: 25 m/s at a grip of 0.05 rest after 51

/// Side by side, so that all four are worked out at once.
struct Wheels {
  std::array<double, 4> x;             ///< in B [m]
  std::array<double, 4> y;             ///< [m]
  std::array<double, 4> deceleration;  ///< of the whole body by this wheel [m/s^2]
};

// The loads balance about the body's origin, which is its centre of mass.
Wheels wheels(const world::Footprint& footprint, double grip) {
  const Vec2 half = half_axes(footprint);
  const Vec2 reach{0.6 * half.x, 0.8 * half.y};
  const double front_share = std::clamp(0.5 * (reach.x - footprint.centre_x) / reach.x, 0.0, 1.0);
  Wheels all{};
  for (std::size_t i = 0; i < 4; ++i) {
    const bool front = i < 2;
    all.x[i] = footprint.centre_x + (front ? reach.x : -reach.x);
    all.y[i] = i % 2 == 0 ? reach.y : -reach.y;
    all.deceleration[i] = 0.5 * (front ? front_share : 1.0 - front_share) * grip * vehicle::gravity;
  }
  return all;
}

// Of the body's origin, the velocity in the turning frame B; also their rates of change.
struct Motion {
  Vec2 p_W;
  double yaw = 0.0;
  Vec2 v_B;
  double yaw_rate = 0.0;
};

Motion advanced(const Motion& from, const Motion& rate, double dt) {
  return {from.p_W + dt * rate.p_W, from.yaw + dt * rate.yaw, from.v_B + dt * rate.v_B,
          from.yaw_rate + dt * rate.yaw_rate};
}

double speed_of(Vec2 v) {
  return std::sqrt(dot(v, v));
}

// (cos, sin) of an angle a little farther; of what a step turns, to 1e-8.
Vec2 turned(Vec2 direction, double angle) {
  const double square = angle * angle;
  const double c = 1.0 + square * (-1.0 / 2.0 + square * (1.0 / 24.0 - square / 720.0));
  const double s = angle * (1.0 + square * (-1.0 / 6.0 + square * (1.0 / 120.0 - square / 5040.0)));
  return {c * direction.x - s * direction.y, s * direction.x + c * direction.y};
}

class Sliding {
 public:
  Sliding(const Wheels& wheels, double mass_over_inertia, double dt)
      : wheels_(wheels),
        mass_over_inertia_(mass_over_inertia),
        dt_(dt),
        resting_(std::max(resting, full_grip * dt)),
        reach_(std::hypot(wheels.x[0] - wheels.x[3], wheels.y[0] - wheels.y[3])) {}

  /// One step, in as many parts as it turns too far for one.
  [[nodiscard]] Motion step(Motion now) const {
    const double wanted = std::abs(now.yaw_rate) * dt_ / most_turned;
    const int parts = static_cast<int>(std::ceil(std::clamp(wanted, 1.0, most_parts)));
    for (int i = 0; i < parts; ++i) {
      now = part(now, dt_ / parts);
    }
    return now;
  }

  [[nodiscard]] bool rests(const Motion& now) const {
    return speed_of(now.v_B) + std::abs(now.yaw_rate) * 0.5 * reach_ < resting_;
  }

 private:
  [[nodiscard]] Motion part(const Motion& now, double dt) const {
    const Vec2 heading{std::cos(now.yaw), std::sin(now.yaw)};
    const auto rate_after = [&](const Motion& rate, double time) {
      const Motion then = advanced(now, rate, time);
      return rate_of(then, turned(heading, then.yaw - now.yaw));
    };
    const Motion k1 = rate_of(now, heading);
    const Motion k2 = rate_after(k1, 0.5 * dt);
    const Motion k3 = rate_after(k2, 0.5 * dt);
    const Motion k4 = rate_after(k3, dt);
    Motion next = advanced(now, k1, dt / 6.0);
    next = advanced(next, k2, dt / 3.0);
    next = advanced(next, k3, dt / 3.0);
    return advanced(next, k4, dt / 6.0);
  }

  [[nodiscard]] Motion rate_of(const Motion& now, Vec2 heading) const {
    std::array<double, 4> pull_x;
    std::array<double, 4> pull_y;
    std::array<double, 4> turning;
    for (std::size_t i = 0; i < 4; ++i) {
      const double v_x = now.v_B.x - now.yaw_rate * wheels_.y[i];
      const double v_y = now.v_B.y + now.yaw_rate * wheels_.x[i];
      const double speed = std::sqrt(v_x * v_x + v_y * v_y);
      const double share = -wheels_.deceleration[i] / (speed > resting_ ? speed : resting_);
      pull_x[i] = share * v_x;
      pull_y[i] = share * v_y;
      turning[i] = wheels_.x[i] * pull_y[i] - wheels_.y[i] * pull_x[i];
    }
    const auto sum = [](const std::array<double, 4>& all) {
      return (all[0] + all[1]) + (all[2] + all[3]);
    };
    const Vec2 a_B{sum(pull_x), sum(pull_y)};
    return {.p_W = {heading.x * now.v_B.x - heading.y * now.v_B.y,
                    heading.y * now.v_B.x + heading.x * now.v_B.y},
            .yaw = now.yaw_rate,
            .v_B = a_B + now.yaw_rate * Vec2{now.v_B.y, -now.v_B.x},
            .yaw_rate = mass_over_inertia_ * sum(turning)};
  }

  Wheels wheels_;
  double mass_over_inertia_;
  double dt_;       ///< [s]
  double resting_;  ///< [m/s]
  double reach_;    ///< from corner to corner [m]
};

}  // namespace

manoeuvre::EgoMotion slide(const world::Footprint& footprint, const collision::ImpactBody& body,
                           const Pose& X_WB, double start, double grip, const SlideSteps& steps) {
  expects(is_finite(X_WB) && is_finite(body.v_W) && std::isfinite(body.yaw_rate) &&
              std::isfinite(start),
          "the body's motion is finite");
  expects(grip > 0.0 && std::isfinite(grip), "grip > 0");
  expects(footprint.length > 0.0 && std::isfinite(footprint.centre_x), "length > 0");
  expects(steps.pose > 0.0 && steps.pose <= 0.05 && steps.per_pose >= 1,
          "steps.pose in (0, 0.05], steps.per_pose >= 1");
  manoeuvre::EgoMotion motion;
  motion.track.start = start;
  motion.track.step = steps.pose;
  motion.ended = true;
  const auto note = [&](const Motion& now, bool rests) {
    motion.track.X_WA.push_back({now.p_W, wrap_angle(now.yaw)});
    motion.v_B.push_back(rests ? Vec2{} : now.v_B);
    motion.yaw_rate.push_back(rests ? 0.0 : now.yaw_rate);
  };
  Motion now{X_WB.p, X_WB.yaw, rotated(body.v_W, -X_WB.yaw), body.yaw_rate};
  const bool moves = body.inverse_mass > 0.0 && body.inverse_yaw_inertia > 0.0;
  const Sliding sliding(wheels(footprint, grip),
                        moves ? body.inverse_yaw_inertia / body.inverse_mass : 0.0,
                        steps.pose / steps.per_pose);
  bool rests = !moves || sliding.rests(now);
  note(now, rests);
  for (int pose = 1; !rests && pose * steps.pose < longest_slide; ++pose) {
    for (int i = 0; i < steps.per_pose && !rests; ++i) {
      now = sliding.step(now);
      rests = sliding.rests(now);
    }
    note(now, rests);
  }
  return motion;
}

}  // namespace saca::rollout
