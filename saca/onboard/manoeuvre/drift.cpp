#include "saca/onboard/manoeuvre/drift.h"

#include <utility>

#include "saca/onboard/manoeuvre/equations.h"

namespace saca::manoeuvre {

using vehicle::Command;
using vehicle::Vehicle;

Command drift_left(const Vehicle& car, const DriftLaw& law, double grip, const DriftMotion& motion,
                   double dt, DriftState& memory) noexcept {
  const equations::Drifting<double> drifting{motion.heading,  motion.v_B.x, motion.v_B.y,
                                             motion.yaw_rate, motion.a_B.x, motion.a_B.y};
  return equations::drift<double, Command>(car, law, grip, drifting, dt, memory);
}

Command drift_right(const Vehicle& car, const DriftLaw& law, double grip, const DriftMotion& motion,
                    double dt, DriftState& memory) noexcept {
  const DriftMotion mirrored{-motion.heading,
                             {motion.v_B.x, -motion.v_B.y},
                             -motion.yaw_rate,
                             {motion.a_B.x, -motion.a_B.y}};
  Command command = drift_left(car, law, grip, mirrored, dt, memory);
  command.steering = -command.steering;
  std::swap(command.brake_torque[vehicle::front_left], command.brake_torque[vehicle::front_right]);
  std::swap(command.brake_torque[vehicle::rear_left], command.brake_torque[vehicle::rear_right]);
  return command;
}

}  // namespace saca::manoeuvre
