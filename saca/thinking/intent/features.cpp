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

double clipped(double x) {
  return std::clamp(x, -most, most);
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

Features ObservationHistory::features() const {
  expects(num_seen_ > 0, "something was seen");
  Features f{};
  const auto set = [&](Feature which, double value) {
    f[static_cast<std::size_t>(which)] = static_cast<float>(clipped(value));
  };
  const Look& now = back(0);
  const Observation& seen = now.seen;
  const std::size_t remembered = std::min(num_seen_ - 1, capacity - 1);
  // Over as much of the time as is remembered; 0 when that is nothing.
  const auto slope = [&](double value_now, auto&& value_then, std::size_t steps,
                         std::size_t known) {
    const std::size_t over = std::min(steps, known);
    return over == 0
               ? 0.0
               : (value_now - value_then(back(over))) / (static_cast<double>(over) * look_step);
  };

  const auto own_speed = [](const Look& look) { return look.seen.speed; };
  const auto speed_slope = [&](std::size_t steps) {
    return slope(seen.speed, own_speed, steps, remembered) / 3.0;
  };
  set(Feature::speed, seen.speed / 30.0);
  set(Feature::acceleration, seen.acceleration / 3.0);
  set(Feature::slope_03, speed_slope(3));
  set(Feature::slope_05, speed_slope(5));
  set(Feature::slope_10, speed_slope(10));
  set(Feature::slope_20, speed_slope(20));
  set(Feature::yaw_rate, seen.yaw_rate / 0.1);
  set(Feature::lateral_acceleration, seen.yaw_rate * seen.speed / 2.0);
  set(Feature::memory, static_cast<double>(remembered) / (capacity - 1));

  if (!std::isnan(seen.offset)) {
    const auto way = [](const Look& look) { return look.lateral; };
    const auto aside = [](const Look& look) { return look.seen.lateral_speed; };
    const auto moved = [&](std::size_t steps) {
      return slope(now.lateral, way, steps, now.in_lane);
    };
    set(Feature::lane_known, 1.0);
    set(Feature::lane_width, seen.lane_width - 3.5);
    set(Feature::to_line, 0.5 * seen.lane_width - std::abs(seen.offset));
    set(Feature::offset, seen.offset);
    set(Feature::lateral_speed, seen.lateral_speed);
    set(Feature::heading, seen.heading / 0.05);
    set(Feature::steered_speed, seen.heading * seen.speed);
    set(Feature::moved_03, moved(3));
    set(Feature::moved_05, moved(5));
    set(Feature::moved_10, moved(10));
    set(Feature::moved_20, moved(20));
    set(Feature::sped_05, slope(seen.lateral_speed, aside, 5, now.in_lane));
    set(Feature::sped_10, slope(seen.lateral_speed, aside, 10, now.in_lane));
    set(Feature::lateral_way, now.lateral - back(now.in_lane).lateral);
  }

  if (!std::isnan(seen.gap)) {
    set(Feature::ahead_known, 1.0);
  }
  if (std::isfinite(seen.gap)) {
    const double gap = std::max(seen.gap, least_gap);
    const double closing = -seen.gap_speed;
    const auto lead = [](const Look& look) { return look.seen.speed + look.seen.gap_speed; };
    set(Feature::somebody_ahead, 1.0);
    set(Feature::nearness, std::exp(-gap / 20.0));
    set(Feature::time_gap, std::exp(-gap / std::max(seen.speed, least_speed) / 2.0));
    set(Feature::closing, closing / 5.0);
    set(Feature::closing_time, closing / gap);
    set(Feature::needed_deceleration, closing > 0.0 ? closing * closing / (2.0 * gap) / 3.0 : 0.0);
    set(Feature::lead_slope_05, slope(lead(now), lead, 5, now.with_lead) / 3.0);
    set(Feature::lead_slope_10, slope(lead(now), lead, 10, now.with_lead) / 3.0);
  }

  if (!std::isnan(seen.throttle)) {
    set(Feature::throttle_known, 1.0);
    set(Feature::throttle, seen.throttle);
  }
  if (!std::isnan(seen.brake)) {
    set(Feature::brake_known, 1.0);
    set(Feature::brake, seen.brake);
  }
  if (!std::isnan(seen.steering)) {
    set(Feature::steering_known, 1.0);
    set(Feature::steering, seen.steering / 0.05);
  }
  return f;
}

}  // namespace saca::intent
