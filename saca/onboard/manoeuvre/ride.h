#pragma once

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::manoeuvre {

/// One manoeuvre under way: a car with its controller on a road, a millisecond at a time.
class Ride {
 public:
  /// The car rolls as the scene's ego does.
  /// @param grip     true friction coefficient, in (0, 1.2]; the controller knows only scene.grip
  /// @param perturbation  what else the controller does not know; its `grip` is a factor of
  ///                 `grip`, and the product at most 1.2
  /// @throws ContractViolation  if refusal(car, plan, scene) has a reason
  Ride(const Car& car, const Plan& plan, const world::Scene& scene, double grip,
       const ParameterPerturbation& perturbation = {});

  /// Asks the controller and goes on by `vehicle::usual_step`. Allocates nothing.
  void step();

  [[nodiscard]] bool ended() const { return finished(state_, memory_); }
  [[nodiscard]] const vehicle::VehicleState& state() const { return state_; }
  /// The car as it is, not as its controller takes it to be; the road's true friction coefficient.
  [[nodiscard]] const vehicle::Vehicle& real() const { return real_; }
  [[nodiscard]] double grip() const { return grip_; }
  [[nodiscard]] const ControllerState& memory() const { return memory_; }
  /// What the controller said at the last step.
  [[nodiscard]] const vehicle::Command& command() const { return command_; }
  [[nodiscard]] vehicle::WheelContacts contacts() const {
    return vehicle::contacts(real_, state_, grip_);
  }

 private:
  Car car_;
  vehicle::Vehicle real_;
  double grip_;
  Plan plan_;
  world::Road road_;
  double known_grip_;
  vehicle::VehicleState state_;
  ControllerState memory_;
  vehicle::Command command_;
};

}  // namespace saca::manoeuvre
