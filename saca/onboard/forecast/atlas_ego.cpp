#include "saca/onboard/forecast/atlas_ego.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/onboard/collision/gap.h"
#include "saca/onboard/forecast/prepared_motion.h"

namespace saca::forecast {
namespace {

using atlas::atlas_samples;
using atlas::AtlasInstant;

}  // namespace

Moments of_halves(double less, double more) noexcept {
  const double mean = (less + more) / std::sqrt(2.0 * std::numbers::pi);
  return {mean, std::max(0.0, 0.5 * (less * less + more * more) - mean * mean)};
}

AtlasEgo::AtlasEgo(const atlas::AtlasPath& path, const world::Scene& scene) noexcept
    : path_(&path),
      scene_(&scene),
      start_(to_lane(scene.road, scene.ego.X_WB)),
      along_{std::cos(scene.road.X_WL.yaw), std::sin(scene.road.X_WL.yaw)},
      at_end_(atlas::at(path, std::nextafter(path.end, 1e9))) {
  last_sample_ = path.rests   ? std::numeric_limits<double>::infinity()
                 : path.ended ? path.end + carried_on_for
                              : path.end;
  fill_directions();
  fill_samples();
  if (scene.grip_sd > 0.0) {
    const double off = scene.grip_sd / scene.grip;
    grip_shares_ = {-atlas::sensitivity_share(1.0 - off), atlas::sensitivity_share(1.0 + off)};
    fill_sensitivities();
  }
}

// What `atlas::at` says, without finding the end anew each time.
AtlasInstant AtlasEgo::on_path(double time) const noexcept {
  if (time <= path_->end || (!path_->rests && !path_->ended)) {
    return atlas::at(*path_, time);
  }
  AtlasInstant now = at_end_;
  now.x += now.x_rate * (time - path_->end);
  return now;
}

Vec2 AtlasEgo::lane_direction(double s) const noexcept {
  const double turned = scene_->road.curvature * s;
  return turned == 0.0 ? along_ : rotated(along_, turned);
}

void AtlasEgo::fill_directions() noexcept {
  for (std::size_t i = 0; i < atlas_samples; ++i) {
    direction(path_->channel[2][i], directions_.cosine[i], directions_.sine[i]);
  }
}

AtlasEgo::PathSamples AtlasEgo::path_samples() const noexcept {
  const atlas::AtlasPath& path = *path_;
  const double per_second =
      path.span > 0.0 ? static_cast<double>(atlas_samples - 1) / path.span : 0.0;
  const bool goes_on = !path.rests && !path.ended;
  PathSamples samples{};
  auto& [x, y, cosine, sine] = samples;
  std::size_t k = 0;
  for (; k <= num_spans && (goes_on || sample_time(k) <= path.end); ++k) {
    const double place = std::min(sample_time(k) * per_second, atlas_samples - 1.001);
    const auto i = static_cast<std::size_t>(place);
    const auto share = static_cast<float>(place - static_cast<double>(i));
    const auto between = [&](const auto& row) { return row[i] + share * (row[i + 1] - row[i]); };
    x[k] = between(path.channel[0]);
    y[k] = between(path.channel[1]);
    cosine[k] = between(directions_.cosine);
    sine[k] = between(directions_.sine);
  }
  const auto end_cosine = static_cast<float>(std::cos(at_end_.heading));
  const auto end_sine = static_cast<float>(std::sin(at_end_.heading));
  for (; k <= num_spans; ++k) {
    x[k] = static_cast<float>(at_end_.x + at_end_.x_rate * (sample_time(k) - path.end));
    y[k] = static_cast<float>(at_end_.y);
    cosine[k] = end_cosine;
    sine[k] = end_sine;
  }
  return samples;
}

void AtlasEgo::fill_samples() noexcept {
  auto [x, y, cosine, sine] = path_samples();
  lane_x_.fill(static_cast<float>(along_.x));
  lane_y_.fill(static_cast<float>(along_.y));
  const Vec2 start_W = scene_->road.X_WL.p - scene_->ego.X_WB.p;
  Vec2 from_W = start_W + start_.s * along_ + start_.d * collision::left_of(along_);
  if (scene_->road.curvature != 0.0) {
    lay_along_arc(x, y);
    from_W = start_W;
  }
  const auto from_x = static_cast<float>(from_W.x);
  const auto from_y = static_cast<float>(from_W.y);
  const auto along_x = static_cast<float>(along_.x);
  const auto along_y = static_cast<float>(along_.y);
  const auto ahead = static_cast<float>(scene_->ego_footprint.centre_x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const float c = lane_x_[i] * cosine[i] - lane_y_[i] * sine[i];
    const float s = lane_y_[i] * cosine[i] + lane_x_[i] * sine[i];
    samples_.cosine[i] = c;
    samples_.sine[i] = s;
    samples_.x[i] = from_x + along_x * x[i] - along_y * y[i] + ahead * c;
    samples_.y[i] = from_y + along_y * x[i] + along_x * y[i] + ahead * s;
  }
  complete(samples_, scene_->ego_footprint);
}

// Turns ways along and across a lane that bends into places in the frame at its X_WL.
void AtlasEgo::lay_along_arc(SampleRow& x, SampleRow& y) noexcept {
  const world::Road arc{.curvature = scene_->road.curvature};
  for (std::size_t k = 0; k <= num_spans; ++k) {
    const world::LanePose pose{start_.s + static_cast<double>(x[k]),
                               start_.d + static_cast<double>(y[k]), 0.0};
    const Pose X_LB = from_lane(arc, pose);
    const Vec2 lane = lane_direction(pose.s);
    x[k] = static_cast<float>(X_LB.p.x);
    y[k] = static_cast<float>(X_LB.p.y);
    lane_x_[k] = static_cast<float>(lane.x);
    lane_y_[k] = static_cast<float>(lane.y);
  }
}

void AtlasEgo::fill_sensitivities() noexcept {
  const atlas::AtlasPath& path = *path_;
  for (const std::size_t c : {0U, 3U}) {
    float most = 0.0F;
    for (std::size_t i = 0; i < atlas::sensitivity_samples; ++i) {
      most = std::max(most, path.sensitivity[c][i] * path.sensitivity[c][i] +
                                path.sensitivity[c + 1][i] * path.sensitivity[c + 1][i]);
    }
    const double share = c == 0 ? grip_shares_.less : grip_shares_.more;
    most_moved_by_grip_ =
        std::max(most_moved_by_grip_, share * std::sqrt(static_cast<double>(most)));
  }
  constexpr double last = atlas::sensitivity_samples - 1;
  const double per_second = path.sensitivity_span > 0.0 ? last / path.sensitivity_span : 0.0;
  const auto of_less = static_cast<float>(path.sensitivity_span > 0.0 ? grip_shares_.less : 0.0);
  const auto of_more = static_cast<float>(path.sensitivity_span > 0.0 ? grip_shares_.more : 0.0);
  for (std::size_t k = 0; k <= num_spans; ++k) {
    const double place = std::min(sample_time(k) * per_second, last);
    const std::size_t i = std::min(static_cast<std::size_t>(place), atlas::sensitivity_samples - 2);
    const auto share = static_cast<float>(place - static_cast<double>(i));
    const auto value = [&](std::size_t c) {
      const auto& row = path.sensitivity[c];
      return row[i] + share * (row[i + 1] - row[i]);
    };
    const float less_x = of_less * value(0);
    const float less_y = of_less * value(1);
    const float more_x = of_more * value(3);
    const float more_y = of_more * value(4);
    sensitivity_at_samples_.less_x[k] = lane_x_[k] * less_x - lane_y_[k] * less_y;
    sensitivity_at_samples_.less_y[k] = lane_y_[k] * less_x + lane_x_[k] * less_y;
    sensitivity_at_samples_.more_x[k] = lane_x_[k] * more_x - lane_y_[k] * more_y;
    sensitivity_at_samples_.more_y[k] = lane_y_[k] * more_x + lane_x_[k] * more_y;
  }
}

world::LanePose AtlasEgo::in_lane(double time) const noexcept {
  const AtlasInstant now = on_path(time);
  return {start_.s + now.x, start_.d + now.y, now.heading};
}

collision::Instant AtlasEgo::at(double time) const noexcept {
  const AtlasInstant now = on_path(time);
  const world::Road& road = scene_->road;
  const double s = start_.s + now.x;
  const double d = start_.d + now.y;
  if (road.curvature == 0.0) {
    const Vec2 across = collision::left_of(along_);
    return {{road.X_WL.p + s * along_ + d * across, wrap_angle(road.X_WL.yaw + now.heading)},
            now.x_rate * along_ + now.y_rate * across,
            now.turn_rate};
  }
  const Pose X_WB = from_lane(road, {s, d, now.heading});
  const double lane_yaw = X_WB.yaw - now.heading;
  return {X_WB, rotated({now.x_rate * (1.0 - road.curvature * d), now.y_rate}, lane_yaw),
          now.turn_rate + road.curvature * now.x_rate};
}

AtlasEgo::Sensitivities AtlasEgo::with_sensitivity(double time) const noexcept {
  const double grip_sd = scene_->grip_sd / scene_->grip;
  const atlas::FrictionSensitivity less =
      atlas::friction_sensitivity_at(*path_, time, 1.0 - grip_sd);
  const atlas::FrictionSensitivity more =
      atlas::friction_sensitivity_at(*path_, time, 1.0 + grip_sd);
  const Vec2 lane = scene_->road.curvature == 0.0 ? along_ : lane_direction(in_lane(time).s);
  const auto in_W = [&](const atlas::FrictionSensitivity& sensitivity) {
    return sensitivity.x * lane + sensitivity.y * collision::left_of(lane);
  };
  return {in_W(less), in_W(more)};
}

}  // namespace saca::forecast
