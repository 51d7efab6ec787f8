#include "saca/thinking/intent/vru.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/thinking/intent/line.h"
#include "saca/thinking/intent/logistic.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::Scene;

// Assumptions, all; see the header.
constexpr double starts = 0.08;            // at rest at the road's edge
constexpr double vru_turns = 0.03;         // walking along the road
constexpr double cyclist_turns = 0.01;     // riding along it
constexpr double per_metre = 0.5;          // of the logit, away from the road
constexpr double per_speed = 3.7;          // of the logit, towards the lane [s/m]
constexpr double stops_unprovoked = 0.03;  // while it does not cross
constexpr double waits_unprovoked = 0.10;  // while it crosses

struct Mark {
  double deceleration;  // [m/s^2]
  double spread;        // [m/s^2]
};
constexpr Mark vru_stops{0.8, 0.15};      // nobody walks so unevenly for long
constexpr Mark cyclist_stops{1.5, 0.25};  // more than coasting

/// How a body lies and moves towards the ego's lane.
struct Approach {
  double distance = 0.0;  ///< to the road's edge, where it is beyond it [m], >= 0
  double speed = 0.0;  ///< towards the middle of the ego's lane; within the lane, across it [m/s]
  double side = 0.0;   ///< to which it would cross: 1 to the left of the lane, -1 to the right
};

Approach approach(const Scene& scene, const Actor& actor) {
  const world::LanePose at = world::to_lane(scene.road, actor.X_WA);
  const double lane_yaw = actor.X_WA.yaw - at.heading;
  const double to_left = rotated(actor.v_W, -lane_yaw).y;
  const double beyond = std::max(at.d - scene.road.left_edge, scene.road.right_edge - at.d);
  const bool within_lane = std::abs(at.d) < 0.5 * scene.road.lane_width;
  double side = at.d > 0.0 ? -1.0 : 1.0;
  if (within_lane && std::abs(to_left) >= rest_speed) {
    side = to_left > 0.0 ? 1.0 : -1.0;
  }
  return {std::max(0.0, beyond), side * to_left, side};
}

double logistic(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}
double logit(double probability) {
  return std::log(probability / (1.0 - probability));
}

}  // namespace

IntentPosterior vru_posterior(const Scene& scene, const Actor& actor) {
  expects(is_vru(actor.kind), "the actor is a pedestrian or a cyclist");
  const Approach there = approach(scene, actor);
  const bool rests = norm(actor.v_W) < rest_speed;
  const bool cycles = actor.kind == world::ActorKind::bicycle;
  double stops = 0.0;
  if (!rests) {
    const Mark& mark = cycles ? cyclist_stops : vru_stops;
    stops = rising(world::is_crossing(scene, actor) ? waits_unprovoked : stops_unprovoked, 0.95,
                   line_of(scene, actor).deceleration, mark.deceleration, mark.spread);
  }
  const double prior = rests ? starts : cycles ? cyclist_turns : vru_turns;
  const double towards = rests ? 0.0 : there.speed;
  const double crosses = logistic(logit(prior) - per_metre * there.distance + per_speed * towards);
  IntentPosterior posterior{};
  posterior[static_cast<std::size_t>(Intention::maintain)] = (1.0 - stops) * (1.0 - crosses);
  posterior[static_cast<std::size_t>(Intention::stop)] = stops;
  posterior[static_cast<std::size_t>(Intention::cross)] = (1.0 - stops) * crosses;
  return posterior;
}

IntentPosterior vru_posterior(const Scene& scene, const Actor& actor, double ahead) {
  expects(ahead >= 0.0, "ahead >= 0");
  Actor later = actor;
  later.X_WA = world::actor_going_on(actor, ahead);
  const double speed = norm(actor.v_W);
  if (speed >= rest_speed) {
    const double gained = dot(actor.a_W, actor.v_W) / speed * ahead;
    const double turned = wrap_angle(later.X_WA.yaw - actor.X_WA.yaw);
    later.v_W = (std::max(0.0, speed + gained) / speed) * rotated(actor.v_W, turned);
    later.a_W = rotated(actor.a_W, turned);
  }
  return vru_posterior(scene, later);
}

Forecast crossing_motion(const Scene& scene, const Actor& actor, double horizon,
                         const MotionLaw& law) {
  expects(is_vru(actor.kind), "the actor is a pedestrian or a cyclist");
  expects(horizon > 0.0, "horizon > 0");
  const world::LanePose at = world::to_lane(scene.road, actor.X_WA);
  const double across = wrap_angle(actor.X_WA.yaw - at.heading +
                                   0.5 * std::numbers::pi * approach(scene, actor).side);
  double speed = norm(actor.v_W);
  double course = speed < rest_speed ? across : std::atan2(actor.v_W.y, actor.v_W.x);
  const double wanted = std::max(speed, law.walking_speed);
  constexpr double dt = motion_step;
  Forecast forecast{
      .track = {.start = scene.time, .step = dt, .X_WA = {actor.X_WA}},
      .spread = {.start = scene.time, .step = dt, .at = {{actor.position_sd, actor.position_sd}}}};
  Vec2 p_W = actor.X_WA.p;
  const int num_steps = static_cast<int>(std::ceil(horizon / dt));
  for (int k = 1; k <= num_steps; ++k) {
    const double faster = std::min(wanted, speed + law.starting * dt);
    const double mean = 0.5 * (speed + faster);
    const double most_turn = law.turning / std::max(mean, rest_speed) * dt;
    const double turn = std::clamp(wrap_angle(across - course), -most_turn, most_turn);
    p_W = p_W + rotated({mean * dt, 0.0}, course + 0.5 * turn);
    course = wrap_angle(course + turn);
    speed = faster;
    forecast.track.X_WA.push_back({p_W, course});
    const double t = k * dt;
    const double sd =
        std::hypot(actor.position_sd, actor.velocity_sd * t, ornstein_uhlenbeck_sd(law.walking, t));
    forecast.spread.at.push_back({sd, sd});
  }
  return forecast;
}

}  // namespace saca::intent
