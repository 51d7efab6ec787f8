#include "saca/world/time_to_conflict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/core/contract.h"
#include "saca/core/units.h"

namespace saca::world {
namespace {

constexpr double shortest_step = 0.01;  // [s], the stated exactness
constexpr double rest_speed = 0.1;      // [m/s]

/// What a body's motion can be within a horizon: its velocity now, and bounds on how it changes.
struct MotionBound {
  Vec2 v_W;                   ///< now [m/s]
  double any_speed = 0.0;     ///< in whatever direction, on top of it [m/s]
  double acceleration = 0.0;  ///< largest, in any direction [m/s^2]
};

/// The ego's lane pose and speed, worked out once for many times.
class EgoLine {
 public:
  explicit EgoLine(const Scene& scene)
      : road_(scene.road),
        start_(to_lane(scene.road, scene.ego.X_WB)),
        speed_(norm(scene.ego.v_B)),
        // Beside the centre line the same way along the lane is longer or shorter.
        along_(speed_ / std::max(0.1, 1.0 - scene.road.curvature * start_.d)),
        corner_speed_(turn_rate() * bounding_radius(scene.ego_footprint)) {}

  [[nodiscard]] Pose at(double after) const {
    return from_lane(road_, {.s = start_.s + along_ * after, .d = start_.d});
  }
  [[nodiscard]] MotionBound bound(const Pose& X_WB) const {
    return {rotated({speed_, 0.0}, X_WB.yaw), corner_speed_, speed_ * turn_rate()};
  }
  [[nodiscard]] double top_speed() const { return speed_ + corner_speed_; }

 private:
  [[nodiscard]] double turn_rate() const { return std::abs(road_.curvature) * along_; }

  Road road_;
  LanePose start_;
  double speed_;
  double along_;
  double corner_speed_;
};

/// The arc that an actor describes.
class ActorLine {
 public:
  /// @param horizon  until when the bounds hold [s]
  explicit ActorLine(const Actor& actor, double horizon = 0.0) : speed_(norm(actor.v_W)) {
    if (speed_ < rest_speed) {
      speed_ = 0.0;
      arc_.X_WL = actor.X_WA;
      return;
    }
    const double course = std::atan2(actor.v_W.y, actor.v_W.x);
    arc_.X_WL = {actor.X_WA.p, course};
    arc_.curvature = actor.yaw_rate / speed_;
    crab_ = wrap_angle(actor.X_WA.yaw - course);
    acceleration_ = dot(actor.a_W, actor.v_W) / speed_;
    fastest_ = speed_ + std::max(0.0, acceleration_) * horizon;
    const double turn_rate = fastest_ * std::abs(arc_.curvature);
    corner_speed_ = turn_rate * bounding_radius(actor.footprint);
    change_ = std::abs(acceleration_) + fastest_ * turn_rate;
  }

  [[nodiscard]] Pose at(double after) const {
    const double moving = until_rest(after);
    const double way = (speed_ + 0.5 * acceleration_ * moving) * moving;
    return from_lane(arc_, {.s = way, .heading = crab_});
  }
  [[nodiscard]] MotionBound bound(double after, const Pose& X_WA) const {
    const double speed = speed_ + acceleration_ * until_rest(after);
    return {rotated({speed, 0.0}, X_WA.yaw - crab_), corner_speed_, change_};
  }
  /// The largest of any of its points within the horizon.
  [[nodiscard]] double top_speed() const { return fastest_ + corner_speed_; }

 private:
  [[nodiscard]] double until_rest(double after) const {
    return acceleration_ < 0.0 ? std::min(after, -speed_ / acceleration_) : after;
  }

  Road arc_;
  double speed_;
  double acceleration_ = 0.0;
  double crab_ = 0.0;
  double fastest_ = 0.0;
  double corner_speed_ = 0.0;
  double change_ = 0.0;  ///< of its velocity, at most [m/s^2]
};

/// A track, seen from scene.time on. Its velocity may jump: nothing but its top speed is known.
class TrackLine {
 public:
  TrackLine(const Track& track, double now, const Footprint& footprint) : track_(track), now_(now) {
    double turn_rate = 0.0;
    for (std::size_t i = 1; i < track.X_WA.size(); ++i) {
      const Pose& a = track.X_WA[i - 1];
      const Pose& b = track.X_WA[i];
      top_speed_ = std::max(top_speed_, norm(b.p - a.p) / track.step);
      turn_rate = std::max(turn_rate, std::abs(wrap_angle(b.yaw - a.yaw)) / track.step);
    }
    top_speed_ += turn_rate * bounding_radius(footprint);
  }

  [[nodiscard]] Pose at(double after) const { return pose_at(track_, now_ + after); }
  [[nodiscard]] MotionBound bound(double, const Pose&) const { return {{}, top_speed_, 0.0}; }
  [[nodiscard]] double top_speed() const { return top_speed_; }

 private:
  const Track& track_;
  double now_;
  double top_speed_ = 0.0;
};

/// How long two bodies surely stay apart: what closes their distance is the part of their relative
/// velocity along the line between their nearest points, and what that may change to.
double surely_apart(const Separation& separation, const MotionBound& a, const MotionBound& b) {
  // Nearest points are exact to 1e-6 m: nearer than that, the line between them has no direction.
  constexpr double nearest_told_apart = 1e-5;  // [m]
  if (separation.distance < nearest_told_apart) {
    return 0.0;
  }
  const Vec2 towards = (1.0 / separation.distance) * (separation.p_b_W - separation.p_a_W);
  const double closing = dot(a.v_W - b.v_W, towards) + a.any_speed + b.any_speed;
  const double change = a.acceleration + b.acceleration;
  // distance = closing t + change t^2 / 2, solved so that no change is no special case.
  const double root = closing + std::sqrt(closing * closing + 2.0 * change * separation.distance);
  return root > 0.0 ? 2.0 * separation.distance / root : std::numeric_limits<double>::infinity();
}

/// Steps as long as the bodies surely stay apart, and no shorter than 10 ms: only a touch that is
/// shorter can be jumped over.
template <class Line>
std::optional<double> first_collision(const Scene& scene, const Actor& actor, const EgoLine& ego,
                                      const Line& line, double horizon) {
  double t = 0.0;
  while (true) {
    const Pose X_WB = ego.at(t);
    const Pose X_WA = line.at(t);
    const Separation now = separation(scene.ego_footprint, X_WB, actor.footprint, X_WA);
    if (now.distance <= 0.0) {
      return t;
    }
    if (t >= horizon) {
      return std::nullopt;
    }
    const double apart = surely_apart(now, ego.bound(X_WB), line.bound(t, X_WA));
    t = std::min(horizon, t + std::max(apart, shortest_step));
  }
}

/// Distance that the ego at X_WB surely keeps from the ground that the actor covers from `begin` to
/// `end`; 0 when it does not.
template <class Line>
double sure_distance(const Scene& scene, const Pose& X_WB, const Actor& actor, const Line& line,
                     double begin, double end) {
  double sure = std::numeric_limits<double>::infinity();
  double t = begin;
  while (true) {
    const Pose X_WA = line.at(t);
    const Separation now = separation(scene.ego_footprint, X_WB, actor.footprint, X_WA);
    if (now.distance <= 0.0) {
      return 0.0;
    }
    // In half the time for which they surely stay apart, no more than half of it is used up.
    sure = std::min(sure, 0.5 * now.distance);
    if (t >= end) {
      return sure;
    }
    const double apart = surely_apart(now, {}, line.bound(t, X_WA));
    t = std::min(end, t + std::max(0.5 * apart, shortest_step));
  }
}

/// The same as `first_collision`, with the actor at any time within the tolerance.
template <class Line>
std::optional<double> first_crossing(const Scene& scene, const Actor& actor, const EgoLine& ego,
                                     const Line& line, double horizon, double tolerance) {
  const double closing = ego.top_speed() + line.top_speed();
  double t = 0.0;
  while (true) {
    const double sure =
        sure_distance(scene, ego.at(t), actor, line, std::max(0.0, t - tolerance), t + tolerance);
    if (sure <= 0.0) {
      return t;
    }
    if (t >= horizon) {
      return std::nullopt;
    }
    t = std::min(horizon, t + std::max(sure / closing, shortest_step));
  }
}

template <class Line>
std::optional<double> first_conflict(const Scene& scene, const Actor& actor, const Line& line,
                                     double horizon, double crossing_tolerance) {
  expects(horizon > 0.0 && std::isfinite(horizon), "horizon > 0");
  expects(crossing_tolerance >= 0.0, "tolerance >= 0");
  const EgoLine ego(scene);
  if (crossing_tolerance > 0.0 && is_crossing(scene, actor)) {
    return first_crossing(scene, actor, ego, line, horizon, crossing_tolerance);
  }
  return first_collision(scene, actor, ego, line, horizon);
}

}  // namespace

Pose ego_going_on(const Scene& scene, double after) {
  return EgoLine(scene).at(after);
}

Pose actor_going_on(const Actor& actor, double after) {
  return ActorLine(actor).at(after);
}

bool is_crossing(const Scene& scene, const Actor& actor) {
  if (norm(actor.v_W) < rest_speed) {
    return false;
  }
  const double course = std::atan2(actor.v_W.y, actor.v_W.x);
  const LanePose there = to_lane(scene.road, {actor.X_WA.p, course});
  return std::abs(std::sin(there.heading)) > std::sin(from_degrees(30.0));
}

bool is_behind(const Scene& scene, const Actor& actor) {
  const Vec2 forward = rotated({1.0, 0.0}, ego_going_on(scene, 0.0).yaw);
  const double rear =
      to_lane(scene.road, {support(scene.ego_footprint, scene.ego.X_WB, -forward), 0.0}).s;
  const double front = to_lane(scene.road, {support(actor.footprint, actor.X_WA, forward), 0.0}).s;
  return front < rear && !is_crossing(scene, actor);
}

bool is_follower(const Scene& scene, const Actor& actor) {
  const double aside = to_lane(scene.road, actor.X_WA).d - to_lane(scene.road, scene.ego.X_WB).d;
  constexpr double standing = 0.5;  // [m/s]
  const bool drives = actor.kind != ActorKind::pedestrian && actor.kind != ActorKind::obstacle &&
                      norm(actor.v_W) >= standing;
  return drives && is_behind(scene, actor) &&
         std::abs(aside) < 0.5 * (actor.footprint.width + scene.ego_footprint.width);
}

std::optional<double> time_to_collision(const Scene& scene, const Actor& actor, const Track& track,
                                        double horizon) {
  return time_to_conflict(scene, actor, track, horizon, 0.0);
}

std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor, const Track& track,
                                       double horizon, double tolerance) {
  return first_conflict(scene, actor, TrackLine(track, scene.time, actor.footprint), horizon,
                        tolerance);
}

std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor, double horizon,
                                       double tolerance) {
  return first_conflict(scene, actor, ActorLine(actor, horizon + tolerance), horizon, tolerance);
}

}  // namespace saca::world
