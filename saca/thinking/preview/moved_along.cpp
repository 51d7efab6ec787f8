#include "saca/thinking/preview/moved_along.h"

namespace saca::preview {

// Of places that lie on straight lines between poses one step apart, differences over a step have
// no jumps.
world::Actor moved_along(world::Actor actor, const world::Track& track, double time) {
  const double h = track.step;
  actor.X_WA = world::pose_at(track, time);
  if (time < track.start + h) {
    return actor;
  }
  const Pose before = world::pose_at(track, time - h);
  const Pose after = world::pose_at(track, time + h);
  actor.v_W = (0.5 / h) * (after.p - before.p);
  actor.a_W = (1.0 / (h * h)) * ((after.p - actor.X_WA.p) - (actor.X_WA.p - before.p));
  actor.yaw_rate = wrap_angle(after.yaw - before.yaw) / (2.0 * h);
  return actor;
}

}  // namespace saca::preview
