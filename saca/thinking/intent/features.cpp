#include "saca/thinking/intent/features.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::intent {
namespace {

constexpr double least_speed = 1.0;  // [m/s] in quotients
constexpr double least_gap = 1.0;    // [m] likewise
constexpr double most = 3.0;         // of quotients that may grow without bound
constexpr double same_lead = 8.0;    // [m] by which a gap may change between looks

void set(Features& f, Feature which, double value) {
  f[static_cast<std::size_t>(which)] = static_cast<float>(std::clamp(value, -most, most));
}

/// @param value  NaN: it is not known
void set_where_known(Features& f, Feature known, Feature which, double value) {
  if (!std::isnan(value)) {
    set(f, known, 1.0);
    set(f, which, value);
  }
}

}  // namespace

Features mirrored(Features features) {
  for (auto i = static_cast<std::size_t>(first_mirrored); i < num_features; ++i) {
    features[i] = -features[i];
  }
  return features;
}

const ObservationHistory::Look& ObservationHistory::back(std::size_t steps) const {
  return looks_[(num_seen_ - 1 - std::min(steps, num_seen_ - 1)) % capacity];
}

void ObservationHistory::add(const Observation& observation) {
  Look look{.seen = observation};
  if (num_seen_ > 0) {
    const Look& last = back(0);
    if (!std::isnan(observation.offset) && !std::isnan(last.seen.offset)) {
      look.lateral = last.lateral + moved_aside(last.seen, observation);
      look.in_lane = std::min(last.in_lane + 1, capacity - 1);
    }
    if (std::isfinite(observation.gap) && std::isfinite(last.seen.gap) &&
        std::abs(observation.gap - last.seen.gap) < same_lead) {
      look.with_lead = std::min(last.with_lead + 1, capacity - 1);
    }
  }
  looks_[num_seen_ % capacity] = look;
  ++num_seen_;
}

double ObservationHistory::slope(double (*value)(const Look&), std::size_t steps,
                                 std::size_t known) const {
  const std::size_t over = std::min(steps, known);
  return over == 0 ? 0.0
                   : (value(back(0)) - value(back(over))) / (static_cast<double>(over) * look_step);
}

void ObservationHistory::tell_motion(Features& f) const {
  const Observation& seen = back(0).seen;
  const std::size_t remembered = std::min(num_seen_ - 1, capacity - 1);
  const auto speed_slope = [&](std::size_t steps) {
    return slope([](const Look& look) { return look.seen.speed; }, steps, remembered) / 3.0;
  };
  set(f, Feature::speed, seen.speed / 30.0);
  set(f, Feature::acceleration, seen.acceleration / 3.0);
  set(f, Feature::slope_03, speed_slope(3));
  set(f, Feature::slope_05, speed_slope(5));
  set(f, Feature::slope_10, speed_slope(10));
  set(f, Feature::slope_20, speed_slope(20));
  set(f, Feature::yaw_rate, seen.yaw_rate / 0.1);
  set(f, Feature::lateral_acceleration, seen.yaw_rate * seen.speed / 2.0);
  set(f, Feature::memory, static_cast<double>(remembered) / (capacity - 1));
}

void ObservationHistory::tell_lane(Features& f) const {
  const Look& now = back(0);
  const Observation& seen = now.seen;
  if (std::isnan(seen.offset)) {
    return;
  }
  const auto moved = [&](std::size_t steps) {
    return slope([](const Look& look) { return look.lateral; }, steps, now.in_lane);
  };
  const auto sped = [&](std::size_t steps) {
    return slope([](const Look& look) { return look.seen.lateral_speed; }, steps, now.in_lane);
  };
  set(f, Feature::lane_known, 1.0);
  set(f, Feature::lane_width, seen.lane_width - 3.5);
  set(f, Feature::to_line, 0.5 * seen.lane_width - std::abs(seen.offset));
  set(f, Feature::offset, seen.offset);
  set(f, Feature::lateral_speed, seen.lateral_speed);
  set(f, Feature::heading, seen.heading / 0.05);
  set(f, Feature::steered_speed, seen.heading * seen.speed);
  set(f, Feature::moved_03, moved(3));
  set(f, Feature::moved_05, moved(5));
  set(f, Feature::moved_10, moved(10));
  set(f, Feature::moved_20, moved(20));
  set(f, Feature::sped_05, sped(5));
  set(f, Feature::sped_10, sped(10));
  set(f, Feature::lateral_way, now.lateral - back(now.in_lane).lateral);
}

void ObservationHistory::tell_lead(Features& f) const {
  const Look& now = back(0);
  const Observation& seen = now.seen;
  if (!std::isnan(seen.gap)) {
    set(f, Feature::ahead_known, 1.0);
  }
  if (!std::isfinite(seen.gap)) {
    return;
  }
  const double gap = std::max(seen.gap, least_gap);
  const double closing = -seen.gap_speed;
  const auto lead_slope = [&](std::size_t steps) {
    return slope([](const Look& look) { return look.seen.speed + look.seen.gap_speed; }, steps,
                 now.with_lead) /
           3.0;
  };
  set(f, Feature::somebody_ahead, 1.0);
  set(f, Feature::nearness, std::exp(-gap / 20.0));
  set(f, Feature::time_gap, std::exp(-gap / std::max(seen.speed, least_speed) / 2.0));
  set(f, Feature::closing, closing / 5.0);
  set(f, Feature::closing_time, closing / gap);
  set(f, Feature::needed_deceleration, closing > 0.0 ? closing * closing / (2.0 * gap) / 3.0 : 0.0);
  set(f, Feature::lead_slope_05, lead_slope(5));
  set(f, Feature::lead_slope_10, lead_slope(10));
}

Features ObservationHistory::features() const {
  expects(num_seen_ > 0, "something was seen");
  Features f{};
  tell_motion(f);
  tell_lane(f);
  tell_lead(f);
  const Observation& seen = back(0).seen;
  set_where_known(f, Feature::throttle_known, Feature::throttle, seen.throttle);
  set_where_known(f, Feature::brake_known, Feature::brake, seen.brake);
  set_where_known(f, Feature::steering_known, Feature::steering, seen.steering / 0.05);
  return f;
}

}  // namespace saca::intent
