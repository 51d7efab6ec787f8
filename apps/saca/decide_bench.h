#pragma once

#include <nlohmann/json.hpp>
#include <random>

#include "apps/saca/inputs.h"
#include "saca/base/core/clock.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/atlas/atlas.h"

namespace saca::app {

/// A scene with `num_actors` others on three lanes; `rng` moves them a little.
[[nodiscard]] world::Scene crowd(const manoeuvre::Car& car, int num_actors, std::mt19937& rng);

/// Percentiles [us] with 1, 8 and 32 others, with somebody behind (.followed) and without:
/// decide.reflex_us, one step of the reflex plane with a verdict that is fresh (.fresh) or with
/// none, so that it makes its own; decide.atlas_judge_us, that alone; decide.verdict_us, one
/// verdict of the forecaster. decide.machine_us is what a loop that only reads the clock has.
/// @param num_calls  of the reflex plane, each
void bench_decide(const Inputs& inputs, const atlas::Atlas& atlas, Clock& clock, int num_calls,
                  nlohmann::json& figures);

}  // namespace saca::app
