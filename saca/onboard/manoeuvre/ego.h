#pragma once

#include "saca/base/world/scene.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// The car's state that moves as the ego does: wheels rolling (or braked, or driven, as its
/// acceleration says), steered as its turning says, actuators and loads settled.
/// @param grip  friction coefficient of the road [-], in (0, 1.2]
/// @throws ContractViolation  if the ego's state is not finite
[[nodiscard]] vehicle::VehicleState rolling_state(const vehicle::Vehicle& car,
                                                  const world::EgoState& ego, double grip);

/// The other way: what the car's sensors say of its state.
[[nodiscard]] world::EgoState ego_state(const vehicle::VehicleState& state);

/// The ground that a car covers.
[[nodiscard]] world::Footprint footprint(const vehicle::Vehicle& car);

}  // namespace saca::manoeuvre
