#include "saca/outcome/closer_look.h"

#include <cmath>

#include "saca/world/footprint.h"

namespace saca::outcome {
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

}  // namespace

CloserLook::CloserLook(const AtlasEgo& ego, std::size_t actor, const Track& track,
                       const Looks& looks) noexcept
    : ego_(&ego),
      actor_(&ego.scene().actors[actor]),
      track_(&track),
      looks_(&looks),
      start_(ego.scene().time),
      reach_(ego.looks().reach + looks.reach + std::abs(ego.scene().ego_footprint.centre_x) +
             std::abs(actor_->footprint.centre_x)),
      spreads_(ego.scene().grip_sd > 0.0 || actor_->position_sd > 0.0 ||
               actor_->velocity_sd > 0.0) {}

bool CloserLook::either_is_round() const noexcept {
  return actor_->footprint.shape == Shape::ellipse ||
         ego_->scene().ego_footprint.shape == Shape::ellipse;
}

double CloserLook::distance_at(double time) const noexcept {
  return separation(ego_->scene().ego_footprint, ego_->at(time).X_WB, actor_->footprint,
                    pose_at(*track_, start_ + time))
      .distance;
}

// Of what is round, the distance where the gap decides on nothing.
double CloserLook::exact(double time, double size) const noexcept {
  return size > 0.0 || !either_is_round() ? size : std::max(size, distance_at(time));
}

double CloserLook::gap_at(double time) const noexcept {
  const Gap gap = gap_between(body_at(ego_->scene().ego_footprint, ego_->at(time).X_WB),
                              body_at(actor_->footprint, on_track(*track_, start_ + time).X_WA));
  return exact(time, gap.size);
}

CloserLook::Look CloserLook::look(double time) const noexcept {
  const Instant ego = ego_->at(time);
  const OnTrack other = on_track(*track_, start_ + time);
  Look now{.time = time};
  now.mine = body_at(ego_->scene().ego_footprint, ego.X_WB);
  now.other = body_at(actor_->footprint, other.X_WA);
  now.gap = gap_between(now.mine, now.other);
  now.size = exact(time, now.gap.size);
  const double turning = reach_ * (std::abs(ego.yaw_rate) + std::abs(other.yaw_rate));
  now.closing = dot(now.gap.n, ego.v_W - other.v_W) + turning;
  return now;
}

double CloserLook::sd_until(double time) const noexcept {
  return actor_->position_sd + actor_->velocity_sd * time + ego_->most_sway();
}

CloserLook::Scores CloserLook::scores(const Look& now) const noexcept {
  const double moved = actor_->velocity_sd * now.time;
  const double of_actor = actor_->position_sd * actor_->position_sd + moved * moved;
  const bool sways = ego_->scene().grip_sd > 0.0;
  const AtlasEgo::Sways grip = sways ? ego_->sways(now.time) : AtlasEgo::Sways{};
  const auto score = [&](const Gap& gap) {
    const Spread along = of_halves(dot(gap.n, grip.less_W), dot(gap.n, grip.more_W));
    const double variance = std::max(of_actor + along.variance, least_sd * least_sd);
    // The ego farther along n leaves a smaller gap.
    return Score{(gap.size - along.mean) / std::sqrt(variance), gap.n};
  };
  Scores all{.most = score(now.gap).size, .of_axis = {}};
  const std::array<Gap, 4> gaps = gaps_along_axes(now.mine, now.other);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    all.of_axis[i] = score(gaps[i]);
    all.most = std::max(all.most, all.of_axis[i].size);
  }
  return all;
}

}  // namespace saca::outcome
