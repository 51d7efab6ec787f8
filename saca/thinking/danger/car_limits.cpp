#include "saca/thinking/danger/car_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"

namespace saca::danger {

Avoidance avoidance_of(const vehicle::Vehicle& car, double grip) {
  expects(grip > 0.0, "grip > 0");
  const double wheelbase = car.cg_to_front_axle + car.cg_to_rear_axle;
  const double front_load = car.cg_to_rear_axle / wheelbase;  // of the weight
  // An axle that takes a part of the drive spins when that exceeds its load's part of the grip.
  const auto most = [](double load, double part) {
    return part > 0.0 ? load / part : std::numeric_limits<double>::infinity();
  };
  const double by_grip = std::min(most(front_load, car.motor_front_share),
                                  most(1.0 - front_load, 1.0 - car.motor_front_share));
  const double by_motor = car.motor_limit / (car.wheel_radius * car.mass * vehicle::gravity * grip);
  return {.grip = grip,
          .tightest_curvature =
              1.0 / std::hypot(wheelbase / std::tan(car.steering_limit), car.cg_to_rear_axle),
          .drive_share = std::min({1.0, by_grip, by_motor}),
          .obstacle_speed = 0.0};
}

}  // namespace saca::danger
