#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/lab/installation/inputs.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/memory/case.h"

namespace saca::vehicle_study {

/// A car, and all that methods are run with in it: in lockstep, without memory and model. It stays
/// where it is: `setup` points to the rest.
struct PlanesOfCar {
  installation::Inputs inputs;
  atlas::Atlas atlas;
  SteadyClock clock;
  runtime::PlanesSetup setup;
};

[[nodiscard]] Result<std::shared_ptr<const PlanesOfCar>> open_planes(
    const installation::Installation& here, installation::Inputs inputs,
    const reflex::Thresholds& thresholds = {});
/// @param car  its file, or the name of a shipped one
[[nodiscard]] Result<std::shared_ptr<const PlanesOfCar>> open_planes(
    const installation::Installation& here, const std::string& car,
    const reflex::Thresholds& thresholds = {});

/// What a case is worked out with there (encounter::made_with).
[[nodiscard]] std::vector<memory::MadeWith> made_with(const PlanesOfCar& planes);

}  // namespace saca::vehicle_study
