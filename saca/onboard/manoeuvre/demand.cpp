#include "saca/onboard/manoeuvre/demand.h"

#include <algorithm>
#include <cmath>

#include "saca/onboard/manoeuvre/equations.h"

namespace saca::manoeuvre {

Demand admissible(const Demand& demand) noexcept {
  const double size = std::hypot(demand.along, demand.across);
  return size > 1.0 ? Demand{demand.along / size, demand.across / size} : demand;
}

vehicle::Command command_for(const Car& car, const Demand& demand, double grip,
                             const vehicle::VehicleState& state, vehicle::AbsState& abs,
                             double dt) noexcept {
  const double most = grip * vehicle::gravity;
  vehicle::Command command;
  const double speed = norm(state.v_B);
  if (speed > 0.0) {
    const double angle = equations::steering_angle<double>(car, state, grip, demand.across * most);
    command.steering = angle * std::min(1.0, speed / equations::crawl);
  }
  if (demand.along < 0.0) {
    command.brake_torque =
        vehicle::deployed_brakes(car, state, -demand.along * most, grip, dt, abs);
    return command;
  }
  abs = vehicle::begin_abs(state.v_B.x);
  const double beside_steering = std::sqrt(std::max(0.0, 1.0 - demand.across * demand.across));
  const double force = std::min(car.mass * demand.along * most,
                                grip * equations::driven_load(car) * beside_steering);
  command.motor_torque = std::min(force * car.wheel_radius, car.motor_limit);
  return command;
}

}  // namespace saca::manoeuvre
