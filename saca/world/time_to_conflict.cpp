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

/// The ego's lane pose and speed, worked out once for many times.
class EgoLine {
 public:
  explicit EgoLine(const Scene& scene)
      : road_(scene.road),
        start_(to_lane(scene.road, scene.ego.X_WB)),
        speed_(norm(scene.ego.v_B)),
        // Beside the centre line the same way along the lane is longer or shorter.
        along_(speed_ / std::max(0.1, 1.0 - scene.road.curvature * start_.d)) {}

  [[nodiscard]] Pose at(double after) const {
    return from_lane(road_, {.s = start_.s + along_ * after, .d = start_.d});
  }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  Road road_;
  LanePose start_;
  double speed_;
  double along_;
};

/// The arc that an actor describes.
class ActorLine {
 public:
  explicit ActorLine(const Actor& actor) : speed_(norm(actor.v_W)) {
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
  }

  [[nodiscard]] Pose at(double after) const {
    const double moving =
        acceleration_ < 0.0 ? std::min(after, -speed_ / acceleration_) : after;  // until at rest
    const double way = (speed_ + 0.5 * acceleration_ * moving) * moving;
    return from_lane(arc_, {.s = way, .heading = crab_});
  }
  /// The largest speed within `horizon`.
  [[nodiscard]] double top_speed(double horizon) const {
    return speed_ + std::max(0.0, acceleration_) * (speed_ > 0.0 ? horizon : 0.0);
  }

 private:
  Road arc_;
  double speed_;
  double acceleration_ = 0.0;
  double crab_ = 0.0;
};

double top_speed(const Track& track) {
  double top = 0.0;
  for (std::size_t i = 1; i < track.X_WA.size(); ++i) {
    top = std::max(top, norm(track.X_WA[i].p - track.X_WA[i - 1].p) / track.step);
  }
  return top;
}

/// Steps no longer than the bodies need to close their distance, and no shorter than 10 ms: nothing
/// is jumped over. Turning moves a corner by at most radius x angle, which the reach adds.
template <class ActorPose>
std::optional<double> first_conflict(const Scene& scene, const Actor& actor, const EgoLine& ego,
                                     ActorPose actor_pose, double actor_speed, double horizon,
                                     double crossing_tolerance) {
  expects(horizon > 0.0, "horizon > 0");
  expects(crossing_tolerance >= 0.0, "tolerance >= 0");
  const double tolerance = is_crossing(scene, actor) ? crossing_tolerance : 0.0;
  // A body that turns at rate w also moves its far corner by w x radius: the ego on its arc, the
  // actor by its measured rate.
  const double corner_speed =
      std::abs(scene.road.curvature) * ego.speed() * bounding_radius(scene.ego_footprint) +
      std::abs(actor.yaw_rate) * bounding_radius(actor.footprint);
  const double closing = ego.speed() + actor_speed + corner_speed;

  // Distance of the ego at `t` from the ground that the actor covers within the tolerance.
  const auto distance_at = [&](double t) {
    const Pose X_WB = ego.at(t);
    double nearest = std::numeric_limits<double>::max();
    double when = std::max(0.0, t - tolerance);
    while (true) {
      const double distance =
          separation(scene.ego_footprint, X_WB, actor.footprint, actor_pose(when)).distance;
      nearest = std::min(nearest, distance);
      if (nearest <= 0.0 || when >= t + tolerance) {
        return nearest;
      }
      const double step = actor_speed > 0.0 ? distance / (actor_speed + corner_speed) : horizon;
      when = std::min(t + tolerance, when + std::max(step, shortest_step));
    }
  };

  double t = 0.0;
  while (t <= horizon) {
    const double distance = distance_at(t);
    if (distance <= 0.0) {
      return t;
    }
    if (closing <= 0.0) {
      return std::nullopt;
    }
    t += std::max(distance / closing, shortest_step);
  }
  return std::nullopt;
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
  return is_behind(scene, actor) &&
         std::abs(aside) < 0.5 * (actor.footprint.width + scene.ego_footprint.width);
}

std::optional<double> time_to_collision(const Scene& scene, const Actor& actor, const Track& track,
                                        double horizon) {
  return time_to_conflict(scene, actor, track, horizon, 0.0);
}

std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor, const Track& track,
                                       double horizon, double tolerance) {
  const auto pose = [&](double after) { return pose_at(track, scene.time + after); };
  return first_conflict(scene, actor, EgoLine(scene), pose, top_speed(track), horizon, tolerance);
}

std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor, double horizon,
                                       double tolerance) {
  const ActorLine line(actor);
  const auto pose = [&](double after) { return line.at(after); };
  return first_conflict(scene, actor, EgoLine(scene), pose, line.top_speed(horizon), horizon,
                        tolerance);
}

}  // namespace saca::world
