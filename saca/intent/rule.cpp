#include "saca/intent/rule.h"

#include "saca/core/contract.h"
#include "saca/intent/line.h"
#include "saca/intent/logistic.h"
#include "saca/intent/motion.h"

namespace saca::intent {
namespace {

constexpr double braking_spread = 0.4;      // [m/s^2], assumption
constexpr double lateral_mark = 0.5;        // [m/s], assumption
constexpr double lateral_spread = 0.12;     // [m/s], assumption
constexpr double lateral_look_ahead = 0.5;  // [s]: a turn counts by the lateral speed it will give

}  // namespace

IntentPosterior vehicle_posterior(const world::Scene& scene, const world::Actor& actor) {
  expects(!is_walker(actor.kind), "the actor is no pedestrian and no cyclist");
  if (actor.kind == world::ActorKind::obstacle || norm(actor.v_W) < rest_speed) {
    return {1.0};
  }
  const Line line = line_of(scene, actor);
  const double unprovoked = line.along_lane ? 0.03 : 0.10;
  const double b = rising(unprovoked, 0.95, line.deceleration, braking_mark, braking_spread);
  const double to_left =
      line.along_lane ? line.lateral : actor.yaw_rate * line.speed * lateral_look_ahead;
  const double l = rising(0.02, 0.90, to_left, lateral_mark, lateral_spread);
  const double r = rising(0.02, 0.90, -to_left, lateral_mark, lateral_spread);
  const double straight = 1.0 - l - r;
  return {(1.0 - b) * straight, (1.0 - b) * l, (1.0 - b) * r, b * straight, b * l, b * r};
}

}  // namespace saca::intent
