#include "saca/onboard/forecast/narrow_phase.h"

#include <algorithm>
#include <cmath>

#include "saca/base/world/footprint.h"

namespace saca::forecast {
namespace {

using world::Shape;
using world::Track;

// A track at one time, found once.
struct OnTrack {
  Pose X_WA;
  Vec2 v_W;
  double yaw_rate = 0.0;
};
OnTrack on_track(const Track& track, double time) noexcept {
  const auto last = static_cast<double>(track.X_WA.size() - 1);
  const double place = (time - track.start) / track.step;
  if (!(place >= 0.0 && place <= last) || last < 1.0) {
    return {place > 0.0 ? track.X_WA.back() : track.X_WA.front(), {}, 0.0};
  }
  const std::size_t i = std::min(static_cast<std::size_t>(place), track.X_WA.size() - 2);
  const double u = place - static_cast<double>(i);
  const Pose& a = track.X_WA[i];
  const Pose& b = track.X_WA[i + 1];
  const Vec2 way = b.p - a.p;
  const double turn = wrap_angle(b.yaw - a.yaw);
  return {{a.p + u * way, a.yaw + u * turn}, (1.0 / track.step) * way, turn / track.step};
}

double largest(const world::Spread& spread) noexcept {
  return std::max(spread.along_sd, spread.across_sd);
}

}  // namespace

NarrowPhase::NarrowPhase(const AtlasEgo& ego, std::size_t actor, const Track& track,
                         const PoseSamples& samples, const world::SpreadOverTime* spread) noexcept
    : ego_(&ego),
      actor_(&ego.scene().actors[actor]),
      track_(&track),
      samples_(&samples),
      spread_(spread == nullptr || spread->at.empty() ? nullptr : spread),
      start_(ego.scene().time),
      reach_(ego.samples().reach + samples.reach + std::abs(ego.scene().ego_footprint.centre_x) +
             std::abs(actor_->footprint.centre_x)),
      spreads_(ego.scene().grip_sd > 0.0 || largest(actor_spread(samples_end)) > 0.0) {}

bool NarrowPhase::either_is_round() const noexcept {
  return actor_->footprint.shape == Shape::ellipse ||
         ego_->scene().ego_footprint.shape == Shape::ellipse;
}

double NarrowPhase::distance_at(double time) const noexcept {
  return separation(ego_->scene().ego_footprint, ego_->at(time).X_WB, actor_->footprint,
                    pose_at(*track_, start_ + time))
      .distance;
}

// Of what is round, the distance where the gap decides on nothing.
double NarrowPhase::exact(double time, double size) const noexcept {
  return size > 0.0 || !either_is_round() ? size : std::max(size, distance_at(time));
}

double NarrowPhase::gap_at(double time) const noexcept {
  const collision::Gap gap = collision::gap_between(
      collision::body_at(ego_->scene().ego_footprint, ego_->at(time).X_WB),
      collision::body_at(actor_->footprint, on_track(*track_, start_ + time).X_WA));
  return exact(time, gap.size);
}

NarrowPhase::PairState NarrowPhase::state_at(double time) const noexcept {
  const collision::Instant ego = ego_->at(time);
  const OnTrack other = on_track(*track_, start_ + time);
  PairState now{.time = time};
  now.mine = collision::body_at(ego_->scene().ego_footprint, ego.X_WB);
  now.other = collision::body_at(actor_->footprint, other.X_WA);
  now.gap = collision::gap_between(now.mine, now.other);
  now.size = exact(time, now.gap.size);
  const double turning = reach_ * (std::abs(ego.yaw_rate) + std::abs(other.yaw_rate));
  now.closing = dot(now.gap.n, ego.v_W - other.v_W) + turning;
  return now;
}

world::Spread NarrowPhase::actor_spread(double time) const noexcept {
  if (spread_ != nullptr) {
    return world::spread_at(*spread_, start_ + time);
  }
  const double moved = actor_->velocity_sd * time;
  const double sd = std::sqrt(actor_->position_sd * actor_->position_sd + moved * moved);
  return {sd, sd};
}

double NarrowPhase::sd_until(double time) const noexcept {
  return largest(actor_spread(time)) + ego_->most_moved_by_grip();
}

Moments NarrowPhase::Doubt::nearer(Vec2 n) const noexcept {
  const double n_along = spread.along_sd * dot(n, along);
  const double n_across = spread.across_sd * dot(n, collision::left_of(along));
  // The ego farther along n leaves a smaller gap.
  const Moments ego = of_halves(dot(n, grip.less_W), dot(n, grip.more_W));
  const double variance = n_along * n_along + n_across * n_across + ego.variance;
  return {ego.mean, std::max(variance, least_sd * least_sd)};
}

Vec2 NarrowPhase::Doubt::displacement_per_metre(Vec2 n) const noexcept {
  const double n_along = spread.along_sd * spread.along_sd * dot(n, along);
  const double n_across = spread.across_sd * spread.across_sd * dot(n, collision::left_of(along));
  const Vec2 of_actor =
      n_along * along + n_across * collision::left_of(along);  // its covariance times n
  const double variance = nearer(n).variance;
  const double of_ego = variance - dot(n, of_actor);
  return (-1.0 / variance) * (of_actor + of_ego * n);
}

NarrowPhase::Doubt NarrowPhase::doubt(const PairState& now) const noexcept {
  return {.spread = actor_spread(now.time),
          .along = now.other.along,
          .grip = ego_->scene().grip_sd > 0.0 ? ego_->with_sensitivity(now.time)
                                              : AtlasEgo::Sensitivities{}};
}

NarrowPhase::Scores NarrowPhase::scores(const PairState& now) const noexcept {
  const Doubt doubts = doubt(now);
  const auto score = [&](const collision::Gap& gap) {
    const Moments nearer = doubts.nearer(gap.n);
    return Score{(gap.size - nearer.mean) / std::sqrt(nearer.variance), gap.n};
  };
  Scores all{.most = score(now.gap).size, .of_axis = {}};
  const std::array<collision::Gap, 4> gaps = collision::gaps_along_axes(now.mine, now.other);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    all.of_axis[i] = score(gaps[i]);
    all.most = std::max(all.most, all.of_axis[i].size);
  }
  return all;
}

}  // namespace saca::forecast
