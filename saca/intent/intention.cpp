#include "saca/intent/intention.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/core/contract.h"
#include "saca/core/names.h"
#include "saca/intent/line.h"
#include "saca/intent/motion.h"
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

constexpr double braking_spread = 0.4;      // [m/s^2], assumption
constexpr double lateral_mark = 0.5;        // [m/s], assumption
constexpr double lateral_spread = 0.12;     // [m/s], assumption
constexpr double lateral_look_ahead = 0.5;  // [s]: a turn counts by the lateral speed it will give

double rising(double low, double high, double value, double mark, double spread) {
  return low + (high - low) / (1.0 + std::exp(-(value - mark) / spread));
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
  const Line line = line_of(scene, actor);
  const double unprovoked = line.along_lane ? 0.03 : 0.10;
  const double b = rising(unprovoked, 0.95, line.deceleration, braking_mark, braking_spread);
  if (actor.kind == ActorKind::pedestrian) {
    return {1.0 - b, 0.0, 0.0, b, 0.0, 0.0};
  }
  const double to_left =
      line.along_lane ? line.lateral : actor.yaw_rate * line.speed * lateral_look_ahead;
  const double l = rising(0.02, 0.90, to_left, lateral_mark, lateral_spread);
  const double r = rising(0.02, 0.90, -to_left, lateral_mark, lateral_spread);
  const double straight = 1.0 - l - r;
  return {(1.0 - b) * straight, (1.0 - b) * l, (1.0 - b) * r, b * straight, b * l, b * r};
}

}  // namespace saca::intent
