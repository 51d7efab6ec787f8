#include "saca/intent/intention.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/core/contract.h"
#include "saca/core/names.h"
#include "saca/world/time_to_conflict.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::ActorKind;
using world::LanePose;
using world::Road;
using world::Scene;
using world::Track;

constexpr std::array<std::string_view, num_intentions> names{"M", "LC", "RC", "FB", "LB", "RB"};

constexpr double rest_speed = 0.1;          // [m/s]
constexpr double braking_mark = 2.0;        // [m/s^2]
constexpr double braking_spread = 0.4;      // [m/s^2], assumption
constexpr double lateral_mark = 0.5;        // [m/s], assumption
constexpr double lateral_spread = 0.12;     // [m/s], assumption
constexpr double assumed_braking = 6.0;     // [m/s^2], assumption: firm, not yet an emergency
constexpr double lane_change_time = 4.0;    // [s], assumption
constexpr double lateral_look_ahead = 0.5;  // [s]: a turn counts by the lateral speed it will give
constexpr double step = 0.05;               // [s]

double rising(double low, double high, double value, double mark, double spread) {
  return low + (high - low) / (1.0 + std::exp(-(value - mark) / spread));
}

double deceleration_along(const Actor& actor) {
  return -dot(actor.a_W, actor.v_W) / norm(actor.v_W);
}

/// The line that the actor drives on, s = 0 at the actor, in its direction of travel; and how its
/// body stands against it.
struct Line {
  Road road;
  bool along_lane;
  double crab;    ///< body heading against the line [rad]
  double offset;  ///< of the actor to the left of the nearest lane's centre [m]; 0 off the lanes
};

Line line_of(const Scene& scene, const Actor& actor) {
  const double course = std::atan2(actor.v_W.y, actor.v_W.x);
  Line line{.road = scene.road,
            .along_lane = !world::is_crossing(scene, actor),
            .crab = 0.0,
            .offset = 0.0};
  if (!line.along_lane) {
    line.road.X_WL = {actor.X_WA.p, course};
    line.road.curvature = actor.yaw_rate / norm(actor.v_W);
    line.crab = wrap_angle(actor.X_WA.yaw - course);
    return line;
  }
  const LanePose at = world::to_lane(scene.road, actor.X_WA);
  const Pose X_WL = world::from_lane(scene.road, {.s = at.s, .d = at.d});
  const double width = scene.road.lane_width;
  const bool oncoming = std::cos(course - X_WL.yaw) < 0.0;
  line.road.curvature = scene.road.curvature / (1.0 - scene.road.curvature * at.d);
  line.road.X_WL = X_WL;
  line.offset = at.d - width * std::round(at.d / width);
  if (oncoming) {
    line.road.X_WL.yaw = wrap_angle(X_WL.yaw + std::numbers::pi);
    line.road.curvature = -line.road.curvature;
    line.offset = -line.offset;
  }
  return line;
}

/// Way to the left [m] that a lane change covers: to the next lane's centre that is still at least
/// a quarter of a lane away.
double lane_change_way(const Line& line, double side) {
  const double width = line.road.lane_width;
  const double to_centre = -side * line.offset;  // of the lane it is in, in the direction of change
  return side * (to_centre > 0.25 * width ? to_centre : to_centre + width);
}

/// 0 to 1 with zero speed and acceleration at both ends.
double smooth(double share) {
  const double x = std::clamp(share, 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}
double smooth_slope(double share) {
  const double x = std::clamp(share, 0.0, 1.0);
  return 30.0 * x * x * (1.0 - x) * (1.0 - x);
}

bool brakes(Intention intention) {
  return intention == Intention::brake || intention == Intention::brake_left ||
         intention == Intention::brake_right;
}

double side_of(Intention intention) {
  switch (intention) {
    case Intention::lane_left:
    case Intention::brake_left:
      return 1.0;
    case Intention::lane_right:
    case Intention::brake_right:
      return -1.0;
    default:
      return 0.0;
  }
}

}  // namespace

std::string_view name(Intention intention) {
  return name_of(intention, names);
}

Intention likeliest(const IntentPosterior& posterior) {
  return static_cast<Intention>(std::max_element(posterior.begin(), posterior.end()) -
                                posterior.begin());
}

IntentPosterior posterior(const Scene& scene, const Actor& actor) {
  if (actor.kind == ActorKind::obstacle || norm(actor.v_W) < rest_speed) {
    return {1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  }
  const double unprovoked = world::is_crossing(scene, actor) ? 0.10 : 0.03;
  const double b =
      rising(unprovoked, 0.95, deceleration_along(actor), braking_mark, braking_spread);
  if (actor.kind == ActorKind::pedestrian) {
    return {1.0 - b, 0.0, 0.0, b, 0.0, 0.0};
  }
  const Line line = line_of(scene, actor);
  const double to_left = line.along_lane ? rotated(actor.v_W, -line.road.X_WL.yaw).y
                                         : actor.yaw_rate * norm(actor.v_W) * lateral_look_ahead;
  const double l = rising(0.02, 0.90, to_left, lateral_mark, lateral_spread);
  const double r = rising(0.02, 0.90, -to_left, lateral_mark, lateral_spread);
  const double straight = 1.0 - l - r;
  return {(1.0 - b) * straight, (1.0 - b) * l, (1.0 - b) * r, b * straight, b * l, b * r};
}

Track predicted_track(const Scene& scene, const Actor& actor, Intention intention, double horizon) {
  expects(horizon > 0.0, "horizon > 0");
  Track track{.start = scene.time, .step = step, .X_WA = {actor.X_WA}};
  const double speed = norm(actor.v_W);
  if (actor.kind == ActorKind::obstacle || speed < rest_speed) {
    return track;
  }
  const Line line = line_of(scene, actor);
  const double measured = deceleration_along(actor);
  const double braking = measured >= braking_mark ? measured : assumed_braking;
  const double deceleration = brakes(intention) ? braking : 0.0;
  const double side = side_of(intention);
  const double way = side == 0.0 ? 0.0 : lane_change_way(line, side);

  const int num_steps = static_cast<int>(std::ceil(horizon / step));
  track.X_WA.reserve(static_cast<std::size_t>(num_steps) + 1);
  for (int k = 1; k <= num_steps; ++k) {
    const double t = k * step;
    const double moving = deceleration > 0.0 ? std::min(t, speed / deceleration) : t;
    const double made = (speed - 0.5 * deceleration * moving) * moving;
    // A change is made along the way, not over time: who stands does not change lanes.
    const double full = speed * lane_change_time;
    const double slope = way * smooth_slope(made / full) / full;
    track.X_WA.push_back(world::from_lane(
        line.road,
        {.s = made, .d = way * smooth(made / full), .heading = line.crab + std::atan(slope)}));
  }
  return track;
}

}  // namespace saca::intent
