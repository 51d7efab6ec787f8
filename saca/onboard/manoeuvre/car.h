#pragma once

#include "saca/onboard/manoeuvre/tuning.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// A car and the numbers with which the controllers drive it.
struct Car : vehicle::Vehicle {
  Tuning tuning;
};

}  // namespace saca::manoeuvre
