#pragma once

#include <memory>
#include <optional>
#include <string>

#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/danger.h"

namespace saca::learned_danger {

/// V_h by a network, its bin's margin added, for danger::DangerModel. About two microseconds.
///
/// It knows of meetings like those that it was trained and its margins were fitted on: a box of 0.4
/// to 18.2 m times 0.4 to 2.9 m that moves at up to 40 m/s and turns and brakes as such bodies may,
/// an ego at up to 40 m/s on grip from 0.2 to 1, a centre within 100 m; more grip is taken as 1. Of
/// a body that is no box the box around it is taken. What it tells by 14 m or more it does not know
/// well (net_inputs.h). In a bin where no margin was shown to be enough it tells danger alone: what
/// it takes there for safe is for others to judge.
/// @param margins  of this network
[[nodiscard]] danger::LearnedValue learned_value(std::shared_ptr<const Network> network,
                                                 const Margins& margins, const manoeuvre::Car& car);

/// Names the car's own numbers, without its tunings: what weights are of.
[[nodiscard]] std::string vehicle_word(const vehicle::Vehicle& car);

}  // namespace saca::learned_danger
