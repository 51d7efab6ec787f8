#pragma once

#include <vector>

#include "saca/lab/tune/fit_log.h"

namespace saca::tune {

/// What one simulation of a log assumes.
struct Hypothesis {
  vehicle::Vehicle car;  ///< its brake_dead_time counts to less than a slot of `BrakeLine`
  double grip = 0.9;     ///< [-], in (0, 1.2]
  double speed = 0.0;    ///< at the first row [m/s], > 0
};

/// Speed that the motor holds during a step steer whose log does not tell its command: the logged
/// one, smoothed [m/s]   (rows). Empty for other logs; without its command the motor holds the
/// first row's speed until a brake test's braking begins, and rests from there on.
[[nodiscard]] std::vector<double> held_speed(const Log& log);

/// The measured signals as the model predicts them from the log's commands alone: the car rolls
/// straight at the first row, and `vehicle::step` does the rest.
///
/// @param held  held_speed(log)
/// @return      SI, in the order of log.measured   (rows x signals, row by row)
///
/// Brake commands are delayed here and not by `BrakeLine`: over each step of at most 1 ms acts the
/// mean of the held command a dead time ago. For a dead time of whole milliseconds and rows at
/// whole milliseconds that is what `BrakeLine` does; between them it makes the response
/// differentiable in the dead time.
[[nodiscard]] std::vector<double> response(const Log& log, const std::vector<double>& held,
                                           const Hypothesis& hypothesis);

}  // namespace saca::tune
