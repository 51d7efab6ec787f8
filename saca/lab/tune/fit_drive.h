#pragma once

#include <cstdint>

#include "saca/lab/tune/fit_log.h"

namespace saca::tune {

/// A test to be driven by the model.
struct TestDrive {
  TestKind kind = TestKind::brake;
  double speed = 20.0;     ///< at the beginning [m/s], in [6, 60]
  double grip = 0.9;       ///< of the road [-], in [0.1, 1.2]
  double steering = 0.03;  ///< a step steer's, > 0 to the left [rad], in [-0.3, 0.3]
  double deceleration =
      12.0;                 ///< wanted of a brake test [m/s^2], > 0; half of it in the first 0.5 s
  double lead_in = 0.5;     ///< before braking or steering begins [s], >= 0.2
  double turning = 2.0;     ///< after a step of steering [s], >= 0.5
  double interval = 0.01;   ///< between rows [s], whole milliseconds, at most 50
  double noise = 1.0;       ///< sd over the sensors' typical noise [-], >= 0
  std::uint64_t seed = 1;   ///< of the noise
  bool motor_known = true;  ///< the motor's command is in the log
};

/// The log of a test that the model drives: to plan a test, and to see what a fit of such a test
/// can find. White noise, no offsets. Some rolling, then braking (to less than 1 m/s; the
/// deployed anti-lock brake reads the model's true state) or the step.
[[nodiscard]] Log drive_test(const vehicle::Vehicle& car, const TestDrive& drive);

}  // namespace saca::tune
