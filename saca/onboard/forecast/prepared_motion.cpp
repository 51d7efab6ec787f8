#include "saca/onboard/forecast/prepared_motion.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::forecast {
namespace {

using manoeuvre::EgoMotion;
using world::Scene;
using world::Track;

// The motion, followed by going on along the lane at the speed and offset of its end.
EgoMotion carried_on(EgoMotion motion, const world::Road& road) {
  const world::LanePose last = to_lane(road, motion.track.X_WA.back());
  const double speed = norm(motion.v_B.back());
  const double along = speed / (1.0 - road.curvature * last.d);  // what s gains per second
  const int num_steps = static_cast<int>(std::ceil(carried_on_for / motion.track.step));
  for (int k = 1; k <= num_steps; ++k) {
    const double s = last.s + along * (k * motion.track.step);
    motion.track.X_WA.push_back(from_lane(road, {s, last.d, last.heading}));
    motion.v_B.push_back(rotated({speed, 0.0}, -last.heading));
    motion.yaw_rate.push_back(along * road.curvature);
  }
  return motion;
}

const EgoMotion& with_velocities(const EgoMotion& motion) {
  expects(!motion.track.X_WA.empty(), "the motion has at least one pose");
  expects(motion.v_B.size() == motion.track.X_WA.size() &&
              motion.yaw_rate.size() == motion.track.X_WA.size(),
          "one velocity and one yaw rate per pose");
  return motion;
}

}  // namespace

PreparedMotion::PreparedMotion(const EgoMotion& motion, const Scene& scene)
    : given_(with_velocities(motion)),
      scene_(scene),
      goes_on_(motion.ended && collision::moves_at_end(motion)),
      carried_on_(goes_on_ ? carried_on(motion, scene.road) : EgoMotion{}) {}

const collision::Mover& PreparedMotion::mover() {
  return mover_ ? *mover_ : mover_.emplace(scene_.ego_footprint, intended().track);
}

std::optional<double> PreparedMotion::crossing(collision::Side side) {
  std::optional<collision::EdgeApproach>& edge = edges_[static_cast<std::size_t>(side)];
  if (!edge) {
    edge = collision::edge_approach(scene_.road, side, scene_.ego_footprint, intended().track, 0.0,
                                    intended().track.start);
  }
  return edge->crossing;
}

const Track& PreparedMotion::in_steps_of(double step) {
  if (!in_steps_) {
    const Track& track = intended().track;
    Track& all = in_steps_.emplace();
    all.start = track.start;
    all.step = std::min(track.step, step);
    const double end = end_time(track);
    for (std::size_t i = 0; i == 0 || all.start + all.step * static_cast<double>(i - 1) <= end;
         ++i) {
      const bool kept = all.step == track.step && i < track.X_WA.size();
      all.X_WA.push_back(kept ? track.X_WA[i]
                              : pose_at(track, all.start + all.step * static_cast<double>(i)));
    }
  }
  return *in_steps_;
}

std::vector<collision::Mover> movers_of(const Scene& scene, std::span<const Track> tracks) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  std::vector<collision::Mover> movers;
  movers.reserve(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    movers.emplace_back(scene.actors[i].footprint, tracks[i]);
  }
  return movers;
}

}  // namespace saca::forecast
