#pragma once

#include <limits>
#include <vector>

namespace saca::recordings {

/// How a motion along one axis was measured, and how much of it is taken for noise.
struct SmootherSettings {
  /// Frequency at which half of a motion's amplitude is taken for noise of the positions [Hz], > 0.
  /// People change acceleration over a second or more; cameras jitter faster.
  double cut_off = 0.45;
  double position_sd = 0.1;  ///< of a measured position [m], > 0
  /// Of a measured speed [m/s], > 0; infinite: speeds are not used. With them motion faster than
  /// the cut-off passes, as far as they are the better measurement of it.
  double speed_sd = std::numeric_limits<double>::infinity();
};

/// A motion along one axis.
struct AxisMotion {
  std::vector<double> position;      ///< [m]
  std::vector<double> velocity;      ///< [m/s]
  std::vector<double> acceleration;  ///< [m/s^2]
};

/// The likeliest motion behind noisy positions at equal steps, from all of them: past and future.
/// For labels, never for inputs of a model that is to foresee.
///
/// @param positions  NaN where there was none: bridged; at least one is known
/// @param speeds     as many, NaN where there was none; or empty
/// @param step       [s], > 0
/// @throws ContractViolation  if sizes, settings or step break these rules or a number is infinite
///
/// Acceleration is a random walk whose size gives the cut-off: far from the ends the smoother
/// passes a share 1 / (1 + (f / cut_off)^6) of frequency f, without delay. Before the first sample
/// any speed up to some 100 m/s and acceleration up to some 10 m/s^2 is likely. Source: Rauch,
/// Tung, Striebel: Maximum Likelihood Estimates of Linear Dynamic Systems, AIAA Journal 3 (8),
/// 1965.
[[nodiscard]] AxisMotion smooth_axis(const std::vector<double>& positions,
                                     const std::vector<double>& speeds, double step,
                                     const SmootherSettings& settings = {});

}  // namespace saca::recordings
