#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace saca::learn {

/// What each class means, in numbers. All are this project's own.
struct LabelRule {
  // A lateral motion: lateral speed of one sign, not below `lateral_ends`. It is a lane change, or
  // an evasion, if it exceeds `lateral_begins` and leads aside by `least_way`; it counts from when
  // it first exceeds that.
  double lateral_begins = 0.35;  ///< [m/s]
  double lateral_ends = 0.2;     ///< [m/s]
  double least_way = 1.0;        ///< [m]
  // Braking: from where a deceleration of `braking_begins` lasts, until it falls below the other.
  double braking_begins = 2.0;  ///< size [m/s^2]
  double braking_ends = 1.0;    ///< size [m/s^2]
  double braking_lasts = 0.3;   ///< [s]
};

constexpr LabelRule label_rule{};

/// What a vehicle truly did.
struct MotionLabels {
  std::vector<std::uint8_t> labels;   ///< as `intent::Intention`, one per sample
  std::vector<double> braking_times;  ///< when braking begins [s] from the first sample on
};

/// Labels a motion that is known without noise, before and after each instant, by `label_rule`.
///
/// @param acceleration   along the motion [m/s^2], finite
/// @param lateral_speed  to the left across the lane [m/s], finite   (as many)
/// @param step           from sample to sample [s], > 0
[[nodiscard]] MotionLabels motion_labels(std::span<const double> acceleration,
                                         std::span<const double> lateral_speed, double step);

/// Which frames are far enough from where the label changes: 0.2 s and more, the change being half
/// way between two frames.
/// @param step  from label to label [s], > 0
[[nodiscard]] std::vector<bool> away_from_changes(std::span<const std::uint8_t> labels,
                                                  double step);

}  // namespace saca::learn
