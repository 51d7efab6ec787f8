#pragma once

#include <optional>
#include <vector>

#include "saca/loop/hindsight.h"
#include "saca/manoeuvre/car.h"
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

using loop::DecisionPoint;

/// What follows from that instant on; nullopt: SACA's trigger never fires. The scenario outlives
/// it.
[[nodiscard]] std::optional<DecisionPoint> decision_point_at_trigger(
    const sim::Scenario& scenario, const manoeuvre::Car& car,
    const preview::Thresholds& thresholds = {});
std::optional<DecisionPoint> decision_point_at_trigger(
    sim::Scenario&& scenario, const manoeuvre::Car& car,
    const preview::Thresholds& thresholds = {}) = delete;

/// The scene as it truly is at a time, among those who are there then.
/// @param time  [s], in [0, scenario.duration]; taken to the nearest 10 ms
[[nodiscard]] world::Scene scene_at(const sim::Scenario& scenario, const manoeuvre::Car& car,
                                    double time);

/// What follows from one instant: among all who are there then or come later
/// (Stepper::whole_scene). The scenario outlives it.
/// @param time    as scene_at
/// @param chance  what is left to it; none: as written
[[nodiscard]] DecisionPoint decision_point_at(const sim::Scenario& scenario,
                                              const manoeuvre::Car& car, double time,
                                              const sim::Chance& chance = {});
DecisionPoint decision_point_at(sim::Scenario&& scenario, const manoeuvre::Car& car, double time,
                                const sim::Chance& chance = {}) = delete;

/// loop::hindsights of the moments that there are, in their places.
[[nodiscard]] std::vector<std::optional<loop::Hindsights>> tried_from(
    const std::vector<std::optional<DecisionPoint>>& points, const manoeuvre::Car& car,
    const outcome::HarmModel& harm, int threads);

}  // namespace saca::eval
