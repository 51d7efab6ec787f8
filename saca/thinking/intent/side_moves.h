#pragma once

#include <vector>

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/line.h"

namespace saca::intent {

/// How people move to the side, and how well that is measured: what a move that is under way may
/// still become is worked out with these.
///
/// Fitted to what is perceived of road users in the tuning split's encounters (docs/forecast.md).
struct SideMoveLaw {
  double time = 2.0;              ///< from begin to end: median [s], > 0
  double time_log_sd = 0.7;       ///< standard deviation of its logarithm [-], > 0
  double size = 2.5;              ///< root mean square of the way made [m], > 0
  double acceleration_sd = 0.3;   ///< of the acceleration to the side as perceived [m/s^2], > 0
  double acceleration_lag = 0.5;  ///< an acceleration is perceived as its mean over the past that
                                  ///< fades with this time [s], > 0
};

/// A move to the side as it is measured; to the left is positive.
struct MeasuredSideMove {
  double speed = 0.0;         ///< [m/s]
  double speed_sd = 0.0;      ///< [m/s], >= 0
  double acceleration = 0.0;  ///< [m/s^2]
};

/// Of who moves along the line.
[[nodiscard]] MeasuredSideMove measured_side_move(const Line& line, const world::Actor& actor);

/// One way in which a move to the side may go on and end: as a polynomial of fifth order in time,
/// without speed and acceleration at its ends.
struct SideMove {
  double probability = 0.0;
  double size = 0.0;     ///< from begin to end, to the left [m]
  double time = 1.0;     ///< likewise [s], > 0
  double share = 0.0;    ///< of its time that has passed, in [0, 1]
  double left_sd = 0.0;  ///< standard deviation of the way that is left [m]

  /// From now on, to the left [m].
  [[nodiscard]] double way(double after) const;
  [[nodiscard]] double speed(double after) const;  ///< [m/s]
  /// Standard deviation of the way by then [m].
  [[nodiscard]] double way_sd(double after) const;
};

/// Of a fixed number of ways in which it may go on, all about alike likely, those that end soonest
/// first. Their probabilities sum to 1.
///
/// Time and progress of the move are unknown: those are likely under which speed and acceleration
/// are as measured, by Bayes' rule on a grid of both; its size follows from each by least squares.
/// How far it is from the middle of the lane that it comes from is not looked at: tried, that made
/// forecasts worse (docs/forecast.md).
///
/// @throws ContractViolation  if a number is out of range
[[nodiscard]] std::vector<SideMove> side_moves(const MeasuredSideMove& measured,
                                               const SideMoveLaw& law = {});

}  // namespace saca::intent
