#include "saca/onboard/manoeuvre/execution.h"

#include <cmath>

#include "saca/onboard/vehicle/abs.h"

namespace saca::manoeuvre {

Execution::Execution(const Car& car, const Plan& plan, const world::Scene& scene)
    : car_(&car),
      refused_(why_refused(car, plan, scene)),
      road_(scene.road),
      controller_(begin(car, refused_ ? full_braking : plan, scene)) {}

vehicle::Command Execution::control(const vehicle::VehicleState& state, double grip,
                                    double dt) noexcept {
  if (!controls_ && std::isfinite(state.v_B.x)) {
    controller_.abs = vehicle::begin_abs(state.v_B.x);
    controls_ = true;
  }
  const vehicle::Command command = manoeuvre::control(*car_, road_, grip, state, controller_, dt);
  finished_ = finished_ || manoeuvre::finished(state, controller_);
  return command;
}

}  // namespace saca::manoeuvre
