#pragma once

#include <nlohmann/json_fwd.hpp>

#include "saca/base/core/clock.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/thinking/intent/model.h"

namespace saca::benchmarks {

/// What decisions are made with.
struct DecisionTools {
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  const intent::Model* intent = nullptr;
  const atlas::Atlas* atlas = nullptr;  ///< of this car
};

/// Percentiles [us] with 1, 8 and 32 others, with somebody behind (.followed) and without:
/// decide.reflex_us, one step of the reflex plane with a verdict that is fresh (.fresh) or with
/// none, so that it makes its own; decide.atlas_judge_us, that alone; decide.verdict_us, one
/// verdict of the forecaster. decide.machine_us is what a loop that only reads the clock has.
/// @param num_calls  of the reflex plane, each, > 0; less where they would take more than 4 s
[[nodiscard]] nlohmann::json decision_times(const DecisionTools& tools, const Clock& clock,
                                            int num_calls);

}  // namespace saca::benchmarks
