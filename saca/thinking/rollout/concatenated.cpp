#include "saca/thinking/rollout/concatenated.h"

#include <algorithm>
#include <cmath>

#include "saca/onboard/collision/impact.h"

namespace saca::rollout {

using manoeuvre::EgoMotion;
using world::Track;

Track concatenated(const Track& before, const Track& after) {
  Track all;
  all.start = before.start;
  all.step = std::min(before.step, after.step);
  const double span = std::max(0.0, end_time(after) - before.start);
  const auto last = static_cast<std::size_t>(std::ceil(span / all.step - 1e-6));
  for (std::size_t i = 0; i <= last; ++i) {
    const double time = all.start + all.step * static_cast<double>(i);
    if (time > after.start) {
      all.X_WA.push_back(pose_at(after, time));
    } else if (all.step == before.step && i < before.X_WA.size()) {
      all.X_WA.push_back(before.X_WA[i]);  // to the last bit
    } else {
      all.X_WA.push_back(pose_at(before, time));
    }
  }
  return all;
}

EgoMotion concatenated(const EgoMotion& before, const EgoMotion& after) {
  EgoMotion all;
  all.track = concatenated(before.track, after.track);
  all.ended = after.ended;
  for (std::size_t i = 0; i < all.track.X_WA.size(); ++i) {
    const double time = all.track.start + all.track.step * static_cast<double>(i);
    const collision::Instant now =
        collision::instant_at(time > after.track.start ? after : before, time);
    all.v_B.push_back(rotated(now.v_W, -now.X_WB.yaw));
    all.yaw_rate.push_back(now.yaw_rate);
  }
  return all;
}

}  // namespace saca::rollout
