#pragma once

#include <array>

namespace saca::vehicle {

// What an independent prototype found for the shipped car: a double track with combined slip,
// integrated by Runge-Kutta at 1 ms, its inputs optimised offline for each case. Ours is held to
// these figures; how near, each user says.

/// One full stop, straight ahead.
struct PrototypeStop {
  double speed = 0.0;     ///< [m/s]
  double grip = 0.0;      ///< friction coefficient [-]
  double distance = 0.0;  ///< of the centre of mass [m]
  double time = 0.0;      ///< [s]
};
inline constexpr std::array<PrototypeStop, 10> prototype_stops{{{8, 0.9, 4.55, 1.04},
                                                                {10, 0.9, 6.81, 1.27},
                                                                {12, 0.9, 9.53, 1.50},
                                                                {14, 0.9, 12.70, 1.73},
                                                                {16, 0.9, 16.32, 1.95},
                                                                {20, 0.9, 24.88, 2.41},
                                                                {25, 0.9, 38.08, 2.97},
                                                                {10, 0.5, 11.34, 2.16},
                                                                {14, 0.5, 21.52, 2.97},
                                                                {20, 0.5, 42.74, 4.19}}};

/// Greatest deceleration of a stop from 14 m/s.
struct PrototypePeak {
  double grip = 0.0;          ///< [-]
  double deceleration = 0.0;  ///< [m/s^2], >= 0
};
inline constexpr std::array<PrototypePeak, 3> prototype_peaks{{{0.9, 8.7}, {0.5, 4.9}, {0.3, 3.0}}};

/// A T-drift to rest, to the left, at grip 0.9.
struct PrototypeDrift {
  double speed = 0.0;    ///< [m/s]
  double time = 0.0;     ///< [s]
  double forward = 0.0;  ///< travel of the centre of mass along the lane [m]
};
inline constexpr std::array<PrototypeDrift, 4> prototype_drifts{
    {{10, 1.58, 7.6}, {12, 1.74, 10.2}, {14, 1.93, 13.5}, {16, 2.21, 17.7}}};
/// Its travel to the left is given as 1.6 to 1.7 m for all speeds; the middle [m].
inline constexpr double prototype_drift_sideways = 1.65;

/// How far ours may be from that: one law for all speeds, where the prototype's inputs were
/// optimised for each. Less travel to the side is less of what a drift is for, more is less room.
inline constexpr double drift_time_band = 0.15;    ///< share of the time [-]
inline constexpr double drift_forward_band = 1.0;  ///< [m]
inline constexpr double drift_least_sideways = 0.75 * prototype_drift_sideways;  ///< [m]
inline constexpr double drift_most_sideways = 2.2;                               ///< [m]

}  // namespace saca::vehicle
