#include "saca/thinking/intent/likely_motions.h"

#include <cmath>
#include <utility>

#include "saca/thinking/intent/line.h"

namespace saca::intent {
namespace {

// Sideways [m/s]: less is told apart from none ever less. Fitted (docs/forecast.md).
constexpr double sure_speed = 0.6;
constexpr double least_likely = 0.01;

/// How likely it is that a measured move to the side ends anywhere; of who follows no lane, 0.
double side_move_probability(const world::Actor& actor, const Line& line) {
  const bool cycles = actor.kind == world::ActorKind::bicycle;
  return (cycles ? cyclist_side_move_share : side_move_share) *
         (1.0 - std::exp(-std::pow(line.lateral / sure_speed, 2.0)));
}

/// As if it did not move to the side.
world::Actor along(const Line& line, world::Actor actor) {
  const Vec2 ahead = rotated({1.0, 0.0}, line.road.X_WL.yaw);
  actor.v_W = std::max(rest_speed, dot(actor.v_W, ahead)) * ahead;
  return actor;
}

/// Some of those who brake do it as in an emergency.
std::vector<LikelyMotion> with_emergencies(const std::vector<LikelyMotion>& intended) {
  std::vector<LikelyMotion> motions;
  for (LikelyMotion one : intended) {
    const bool may_be_hard = is_braking(one.intention) && one.intention != Intention::stop;
    if (may_be_hard) {
      LikelyMotion hard = one;
      hard.hard = true;
      hard.probability *= hard_braking_share;
      motions.push_back(hard);
      one.probability -= hard.probability;
    }
    motions.push_back(one);
  }
  return motions;
}

/// Of who brakes as in an emergency.
MotionLaw hard_braking(MotionLaw law) {
  law.braking = 6.0;
  law.braking_log_sd = 0.35;
  law.braking_rise = 0.5;
  law.holds = false;
  return law;
}

}  // namespace

std::vector<LikelyMotion> intended_motions(const Belief& belief) {
  std::vector<LikelyMotion> motions;
  double sum = 0.0;
  for (const Intention intention : all_intentions) {
    const double p = belief.now()[static_cast<std::size_t>(intention)];
    if (p >= least_likely) {
      motions.push_back({p, intention, std::nullopt});
      sum += p;
    }
  }
  for (LikelyMotion& one : motions) {
    one.probability /= sum;
  }
  return motions;
}

std::vector<LikelyMotion> likely_motions(const world::Scene& scene, const world::Actor& actor,
                                         const Belief& belief, const SideMoveLaw& law) {
  std::vector<LikelyMotion> motions = with_emergencies(intended_motions(belief));
  if (actor.kind == world::ActorKind::obstacle || norm(actor.v_W) < rest_speed) {
    return motions;
  }
  const Line line = line_of(scene, actor);
  const double of_side_moves = side_move_probability(actor, line);
  if (of_side_moves < least_likely) {
    return motions;
  }
  double brakes = 0.0;
  for (LikelyMotion& one : motions) {
    brakes += is_braking(one.intention) ? one.probability : 0.0;
    one.probability *= 1.0 - of_side_moves;
  }
  const Intention slower = is_vru(actor.kind) ? Intention::stop : Intention::brake;
  for (const SideMove& move : side_moves(measured_side_move(line, actor), law)) {
    for (const bool braking : {false, true}) {
      const double p = braking ? brakes : 1.0 - brakes;
      if (p > 0.0) {
        motions.push_back(
            {of_side_moves * p * move.probability, braking ? slower : Intention::maintain, move});
      }
    }
  }
  return motions;
}

Forecast forecast_of(const LikelyMotion& motion, const world::Scene& scene,
                     const world::Actor& actor, double horizon, const MotionLaw& law) {
  if (!motion.aside) {
    return motion_under(scene, actor, motion.intention, horizon,
                        motion.hard ? hard_braking(law) : law);
  }
  const Line line = line_of(scene, actor);
  const world::Actor on = along(line, actor);
  Forecast forecast = motion_under(scene, on, motion.intention, horizon, law);
  double made = 0.0;  // along the lane [m]
  Vec2 before_W = forecast.track.X_WA.front().p;
  for (std::size_t k = 1; k < forecast.track.X_WA.size(); ++k) {
    Pose& pose = forecast.track.X_WA[k];
    made += norm(pose.p - std::exchange(before_W, pose.p));
    // The move is made along the way: who stops does not go on aside.
    const double after = is_braking(motion.intention)
                             ? made / norm(on.v_W)
                             : static_cast<double>(k) * forecast.track.step;
    pose.p = pose.p + rotated({0.0, motion.aside->way(after)}, pose.yaw);
    pose.yaw = wrap_angle(pose.yaw + std::atan2(motion.aside->speed(after), line.speed));
    forecast.spread.at[k].across_sd = std::hypot(actor.position_sd, motion.aside->way_sd(after));
  }
  return forecast;
}

}  // namespace saca::intent
