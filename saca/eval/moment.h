#pragma once

#include <array>
#include <optional>

#include "saca/loop/hindsight.h"
#include "saca/manoeuvre/car.h"
#include "saca/outcome/outcome.h"
#include "saca/preview/threat.h"
#include "saca/sim/chance.h"
#include "saca/sim/scenario.h"

namespace saca::eval {

/// When SACA's trigger fires if the ego goes on as the scenario has it: the first look, every
/// 10 ms, at which a conflict is within T1 (preview::nearest_threat, perfect perception); nullopt:
/// never.
/// @param thresholds  T1 and its tolerance
[[nodiscard]] std::optional<double> trigger_time(const sim::Scenario& scenario,
                                                 const manoeuvre::Car& car,
                                                 const preview::Thresholds& thresholds = {});

/// One instant of a scenario, and what follows from it: all that a policy's outcome depends on. The
/// scenario outlives it.
struct Moment {
  world::Scene scene;      ///< Stepper::whole_scene, but for the grip, which the ego believes in
  outcome::Others others;  ///< what the others do from then on, the ego's motion given
  double grip = 0.0;       ///< of the road as written; `unknown` may change it
  manoeuvre::Unknown unknown;
};

/// The scene as it truly is at a time, among those who are there then.
/// @param time  [s], in [0, scenario.duration]; taken to the nearest 10 ms
[[nodiscard]] world::Scene scene_at(const sim::Scenario& scenario, const manoeuvre::Car& car,
                                    double time);

/// @param time    as scene_at
/// @param chance  what is left to it; none: as written
[[nodiscard]] Moment moment_at(const sim::Scenario& scenario, const manoeuvre::Car& car,
                               double time, const sim::Chance& chance = {});
Moment moment_at(sim::Scenario&& scenario, const manoeuvre::Car& car, double time,
                 const sim::Chance& chance = {}) = delete;

/// All eight policies begun at this moment, each driven and judged to its end.
[[nodiscard]] std::array<loop::Hindsight, manoeuvre::num_policies> attempts(
    const Moment& moment, const manoeuvre::Car& car, const outcome::HarmModel& harm);

}  // namespace saca::eval
