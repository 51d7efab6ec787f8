#include "saca/base/world/track.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::world {
namespace {

/// The segment that holds a time, and where in it; nullopt outside the track.
struct Place {
  std::size_t segment;
  double share;
};

void check(const Track& track) {
  expects(!track.X_WA.empty(), "a track has at least one pose");
  expects(track.step > 0.0, "step > 0");
}

bool inside(const Track& track, double time) {
  return time >= track.start && time <= end_time(track) && track.X_WA.size() > 1;
}

Place place(const Track& track, double time) {
  const double steps = (time - track.start) / track.step;
  const auto last = static_cast<double>(track.X_WA.size() - 2);
  const double segment = std::clamp(std::floor(steps), 0.0, last);
  return {static_cast<std::size_t>(segment), std::clamp(steps - segment, 0.0, 1.0)};
}

}  // namespace

Spread spread_at(const SpreadOverTime& spread, double time) {
  expects(!spread.at.empty(), "a spread is told");
  const std::size_t last = spread.at.size() - 1;
  const double steps =
      std::clamp((time - spread.start) / spread.step, 0.0, static_cast<double>(last));
  const auto before = static_cast<std::size_t>(steps);
  const Spread& a = spread.at[before];
  const Spread& b = spread.at[std::min(before + 1, last)];
  const double share = steps - static_cast<double>(before);
  return {std::lerp(a.along_sd, b.along_sd, share), std::lerp(a.across_sd, b.across_sd, share)};
}

double end_time(const Track& track) {
  check(track);
  return track.start + track.step * static_cast<double>(track.X_WA.size() - 1);
}

Pose pose_at(const Track& track, double time) {
  check(track);
  expects(std::isfinite(time), "time is finite");
  if (!inside(track, time)) {
    return time <= track.start ? track.X_WA.front() : track.X_WA.back();
  }
  const Place at = place(track, time);
  return between(track.X_WA[at.segment], track.X_WA[at.segment + 1], at.share);
}

Vec2 velocity_at(const Track& track, double time) {
  check(track);
  if (!inside(track, time)) {
    return {};
  }
  const std::size_t i = place(track, time).segment;
  return (1.0 / track.step) * (track.X_WA[i + 1].p - track.X_WA[i].p);
}

double yaw_rate_at(const Track& track, double time) {
  check(track);
  if (!inside(track, time)) {
    return 0.0;
  }
  const std::size_t i = place(track, time).segment;
  return wrap_angle(track.X_WA[i + 1].yaw - track.X_WA[i].yaw) / track.step;
}

}  // namespace saca::world
