#pragma once

#include <optional>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// Carries one plan out: from the scene in which it begins to its safe end, and on.
///
/// A copy goes on by itself. Allocates nothing.
class Execution {
 public:
  /// Begins now. A plan that cannot be driven from here gives way to full braking, which always
  /// can.
  /// @param car    outlives this
  /// @param scene  its ego, road and grip count
  Execution(const Car& car, const Plan& plan, const world::Scene& scene);

  /// What is carried out.
  [[nodiscard]] const Plan& plan() const noexcept { return controller_.plan; }
  /// Why the plan that was asked for is not; nullopt: it is.
  [[nodiscard]] const std::optional<Refusal>& refused() const noexcept { return refused_; }

  /// What to tell the car now, as `manoeuvre::control`. Brakes begin with the speed that the car
  /// measures at the first call: a scene may err, and brakes that believe it would take wheels that
  /// roll for locked ones.
  [[nodiscard]] vehicle::Command control(const vehicle::VehicleState& state, double grip,
                                         double dt) noexcept;

  /// Whether its safe end is at rest (`manoeuvre::ends_at_rest`).
  [[nodiscard]] bool ends_at_rest() const noexcept { return manoeuvre::ends_at_rest(controller_); }

  /// Whether the plan has reached its safe end (`manoeuvre::finished`) by the last call of
  /// `control`, or before.
  [[nodiscard]] bool finished() const noexcept { return finished_; }

 private:
  const Car* car_;
  std::optional<Refusal> refused_;
  world::Road road_;  ///< where the plan began
  ControllerState controller_;
  bool controls_ = false;  ///< `control` has been called with a speed
  bool finished_ = false;
};

}  // namespace saca::manoeuvre
