#include "saca/base/world/time_to_conflict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::world {
namespace {

constexpr double shortest_step = 0.01;  // [s], the stated exactness
constexpr double rest_speed = 0.1;      // [m/s]

// What a driver does who keeps speed and lane, and what sensors err by: only what is beyond it is
// taken for braking or turning. Assumptions: engine braking and air resistance at 30 m/s decelerate
// a car by some 0.5 m/s^2, and drivers who keep their lane (0.2 m of standard deviation, Verster
// and Roth, Int. J. General Medicine 4, 2011) correct it within a second or two.
constexpr double unnoticed_deceleration = 0.5;     // [m/s^2]
constexpr double lane_keeping_speed = 0.5;         // across the lane [m/s]
constexpr double lane_keeping_acceleration = 0.5;  // likewise [m/s^2]

/// What a body's motion can be within a horizon: its velocity now, and bounds on how it changes.
struct MotionBound {
  Vec2 v_W;                   ///< now [m/s]
  double any_speed = 0.0;     ///< in whatever direction, on top of it [m/s]
  double acceleration = 0.0;  ///< largest, in any direction [m/s^2]
};

/// An arc that a body describes, with a constant acceleration along it until it is at rest.
struct Arc {
  Pose X_WC;                  ///< where it is now, x along its course
  double crab = 0.0;          ///< of the body's heading against its course [rad]
  double curvature = 0.0;     ///< [1/m]
  double speed = 0.0;         ///< [m/s], >= 0
  double acceleration = 0.0;  ///< along the arc [m/s^2]
};

/// @return  0 within the band, beyond it what is beyond: a measured value and its noise count from
///          there on, without a jump
double beyond_band(double value, double band) {
  return value > 0.0 ? std::max(0.0, value - band) : std::min(0.0, value + band);
}

/// Who rolls backwards goes on nowhere: it is not foreseen where.
Arc lane_arc(const Scene& scene) {
  const EgoState& ego = scene.ego;
  const LanePose here = to_lane(scene.road, ego.X_WB);
  const bool rolls_back = ego.v_B.x < 0.0 && rotated(ego.v_B, here.heading).x < 0.0;
  return {.X_WC = {ego.X_WB.p, wrap_angle(ego.X_WB.yaw - here.heading)},
          // Beside the centre line the same way along the lane is longer or shorter.
          .curvature = scene.road.curvature / std::max(0.1, 1.0 - scene.road.curvature * here.d),
          .speed = rolls_back ? 0.0 : norm(ego.v_B)};
}

Arc measured_arc(const Scene& scene) {
  const EgoState& ego = scene.ego;
  Arc arc = lane_arc(scene);
  if (ego.v_B.x < rest_speed) {
    return arc;
  }
  const double speed = arc.speed;
  const double course = ego.X_WB.yaw + std::atan2(ego.v_B.y, ego.v_B.x);
  const double across = speed * std::sin(course - arc.X_WC.yaw);
  const double aside = speed * (ego.yaw_rate - speed * arc.curvature);
  arc.X_WC.yaw =
      wrap_angle(arc.X_WC.yaw + std::asin(beyond_band(across, lane_keeping_speed) / speed));
  arc.curvature += beyond_band(aside, lane_keeping_acceleration) / (speed * speed);
  arc.acceleration =
      std::min(0.0, beyond_band(dot(ego.a_B, ego.v_B) / speed, unnoticed_deceleration));
  return arc;
}

Arc ego_arc(const Scene& scene, EgoPrediction prediction) {
  return prediction == EgoPrediction::as_measured ? measured_arc(scene) : lane_arc(scene);
}

Arc actor_arc(const Actor& actor) {
  const double speed = norm(actor.v_W);
  if (speed < rest_speed) {
    return {.X_WC = actor.X_WA};
  }
  const double course = std::atan2(actor.v_W.y, actor.v_W.x);
  return {.X_WC = {actor.X_WA.p, course},
          .crab = wrap_angle(actor.X_WA.yaw - course),
          .curvature = actor.yaw_rate / speed,
          .speed = speed,
          .acceleration = dot(actor.a_W, actor.v_W) / speed};
}

/// A body on its arc, worked out once for many times.
class ArcLine {
 public:
  /// @param radius   of a circle about its centre that holds the body [m]
  /// @param horizon  until when the bounds hold [s]
  explicit ArcLine(const Arc& arc, double radius = 0.0, double horizon = 0.0)
      : crab_(arc.crab),
        speed_(arc.speed),
        acceleration_(arc.acceleration),
        fastest_(arc.speed + std::max(0.0, arc.acceleration) * horizon) {
    path_.X_WL = arc.X_WC;
    path_.curvature = arc.curvature;
    const double turn_rate = fastest_ * std::abs(arc.curvature);
    corner_speed_ = turn_rate * radius;
    change_ = std::abs(acceleration_) + fastest_ * turn_rate;
  }

  [[nodiscard]] Pose at(double after) const {
    const double moving = until_rest(after);
    const double way = (speed_ + 0.5 * acceleration_ * moving) * moving;
    return from_lane(path_, {.s = way, .heading = crab_});
  }
  [[nodiscard]] MotionBound bound(double after, const Pose& X_W) const {
    const double speed = speed_ + acceleration_ * until_rest(after);
    return {rotated({speed, 0.0}, X_W.yaw - crab_), corner_speed_, change_};
  }
  /// The largest of any of its points within the horizon.
  [[nodiscard]] double top_speed() const { return fastest_ + corner_speed_; }

 private:
  [[nodiscard]] double until_rest(double after) const {
    return acceleration_ < 0.0 ? std::min(after, -speed_ / acceleration_) : after;
  }

  Road path_;
  double crab_;
  double speed_;
  double acceleration_;
  double fastest_;
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
std::optional<double> first_collision(const Scene& scene, const Actor& actor, const ArcLine& ego,
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
    const double apart = surely_apart(now, ego.bound(t, X_WB), line.bound(t, X_WA));
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
std::optional<double> first_crossing(const Scene& scene, const Actor& actor, const ArcLine& ego,
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
                                     double horizon, double crossing_tolerance,
                                     EgoPrediction prediction) {
  expects(horizon > 0.0 && std::isfinite(horizon), "horizon > 0");
  expects(crossing_tolerance >= 0.0, "tolerance >= 0");
  const ArcLine ego(ego_arc(scene, prediction), bounding_radius(scene.ego_footprint), horizon);
  if (crossing_tolerance > 0.0 && is_crossing(scene, actor)) {
    return first_crossing(scene, actor, ego, line, horizon, crossing_tolerance);
  }
  return first_collision(scene, actor, ego, line, horizon);
}

}  // namespace

Pose ego_going_on(const Scene& scene, double after, EgoPrediction prediction) {
  return ArcLine(ego_arc(scene, prediction)).at(after);
}

Pose actor_going_on(const Actor& actor, double after) {
  return ArcLine(actor_arc(actor)).at(after);
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
                        tolerance, EgoPrediction::in_lane);
}

std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor, double horizon,
                                       double tolerance, EgoPrediction prediction) {
  return first_conflict(
      scene, actor,
      ArcLine(actor_arc(actor), bounding_radius(actor.footprint), horizon + tolerance), horizon,
      tolerance, prediction);
}

}  // namespace saca::world
