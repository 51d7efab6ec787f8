#include "saca/onboard/vehicle/abs.h"

#include "saca/onboard/vehicle/abs_equations.h"

namespace saca::vehicle {
namespace {

// What all four tyres give at their peaks, once the load has moved for full grip [m/s^2].
double lasting_deceleration(const Vehicle& car, double grip) {
  const PerWheel loads = wheel_loads(car, {-grip * gravity, 0.0});
  double force = 0.0;
  for (const double load : loads) {
    force += peak_friction(car.tyre, load, grip) * load;
  }
  return force / car.mass;
}

}  // namespace

PerWheel ideal_brakes(const Vehicle& car, const VehicleState& state, double grip) noexcept {
  constexpr double margin = 0.99;  // the peak itself is the edge of locking
  const double deceleration = lasting_deceleration(car, grip);
  const PerWheel loads =
      equations::lasting_loads(car, state.transfer_a_B.x, state.transfer_a_B.y, deceleration);
  PerWheel torque{};
  for (std::size_t i = 0; i < num_wheels; ++i) {
    torque[i] = margin * peak_friction(car.tyre, loads[i], grip) * loads[i] * car.wheel_radius +
                equations::slowing_torque(car, i, deceleration);
  }
  return torque;
}

AbsState begin_abs(double speed) noexcept {
  return {.speed = speed};
}

PerWheel deployed_brakes(const Vehicle& car, const VehicleState& state, double deceleration,
                         double grip, double dt, AbsState& abs) noexcept {
  return equations::deployed_brakes(car, state, deceleration, grip, dt, abs);
}

}  // namespace saca::vehicle
