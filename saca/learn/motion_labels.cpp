#include "saca/learn/motion_labels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "saca/core/contract.h"
#include "saca/intent/intention.h"

namespace saca::learn {
namespace {

using intent::Intention;

/// +1 to the left, -1 to the right, 0 neither; per sample.
std::vector<int> sides(std::span<const double> lateral_speed, double step) {
  std::vector<int> all(lateral_speed.size(), 0);
  for (std::size_t begin = 0; begin < all.size();) {
    const double sign = lateral_speed[begin] < 0.0 ? -1.0 : 1.0;
    std::size_t end = begin;
    std::size_t fast = all.size();  // the first sample that exceeds `lateral_begins`
    double way = 0.0;
    while (end < all.size() && sign * lateral_speed[end] >= label_rule.lateral_ends) {
      if (sign * lateral_speed[end] > label_rule.lateral_begins) {
        fast = std::min(fast, end);
      }
      way += sign * lateral_speed[end] * step;
      ++end;
    }
    if (way >= label_rule.least_way && fast < end) {
      std::fill(all.begin() + static_cast<std::ptrdiff_t>(fast),
                all.begin() + static_cast<std::ptrdiff_t>(end), sign > 0.0 ? 1 : -1);
    }
    begin = std::max(end, begin + 1);
  }
  return all;
}

struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The first stretch from `from` on over which hard braking has lasted long enough.
Stretch hard_stretch(std::span<const double> acceleration, std::size_t from, std::size_t lasting) {
  std::size_t run = 0;
  for (std::size_t i = from; i < acceleration.size(); ++i) {
    run = acceleration[i] <= -label_rule.braking_begins ? run + 1 : 0;
    if (run == lasting) {
      return {i + 1 - lasting, i + 1};
    }
  }
  return {acceleration.size(), acceleration.size()};
}

std::vector<Stretch> brakings(std::span<const double> acceleration, double step) {
  const auto lasting =
      static_cast<std::size_t>(std::max(1.0, std::round(label_rule.braking_lasts / step)));
  std::vector<Stretch> all;
  for (std::size_t from = 0; from < acceleration.size();) {
    Stretch stretch = hard_stretch(acceleration, from, lasting);
    while (stretch.end < acceleration.size() &&
           acceleration[stretch.end] < -label_rule.braking_ends) {
      ++stretch.end;
    }
    if (stretch.begin < stretch.end) {
      all.push_back(stretch);
    }
    from = stretch.end;
  }
  return all;
}

Intention intention_of(bool braking, int side) {
  if (braking) {
    return side > 0 ? Intention::brake_left : side < 0 ? Intention::brake_right : Intention::brake;
  }
  return side > 0 ? Intention::lane_left : side < 0 ? Intention::lane_right : Intention::maintain;
}

bool are_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

MotionLabels motion_labels(std::span<const double> acceleration,
                           std::span<const double> lateral_speed, double step) {
  expects(acceleration.size() == lateral_speed.size(), "as many accelerations as lateral speeds");
  expects(step > 0.0, "step > 0");
  expects(are_finite(acceleration) && are_finite(lateral_speed), "a motion without gaps");
  const std::vector<int> side = sides(lateral_speed, step);
  std::vector<bool> braking(acceleration.size(), false);
  MotionLabels all;
  for (const Stretch& stretch : brakings(acceleration, step)) {
    all.braking_times.push_back(static_cast<double>(stretch.begin) * step);
    std::fill(braking.begin() + static_cast<std::ptrdiff_t>(stretch.begin),
              braking.begin() + static_cast<std::ptrdiff_t>(stretch.end), true);
  }
  all.labels.reserve(side.size());
  for (std::size_t i = 0; i < side.size(); ++i) {
    all.labels.push_back(static_cast<std::uint8_t>(intention_of(braking[i], side[i])));
  }
  return all;
}

std::vector<bool> away_from_changes(std::span<const std::uint8_t> labels, double step) {
  expects(step > 0.0, "step > 0");
  constexpr double doubt = 0.2;  // [s]: as far as two people would put the instant differently
  const auto near = static_cast<std::size_t>(std::ceil(doubt / step));
  std::vector<bool> away(labels.size(), true);
  for (std::size_t change = 1; change < labels.size(); ++change) {
    if (labels[change] == labels[change - 1]) {
      continue;
    }
    const std::size_t begin = change - std::min(change, near);
    const std::size_t end = std::min(labels.size(), change + near);
    std::fill(away.begin() + static_cast<std::ptrdiff_t>(begin),
              away.begin() + static_cast<std::ptrdiff_t>(end), false);
  }
  return away;
}

}  // namespace saca::learn
