#pragma once

#include <optional>
#include <vector>

#include "saca/lab/encounter/hindsight.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::eval {

/// When SACA's trigger fires if the ego goes on as the scenario has it: the first look, every
/// 10 ms, at which a conflict is within T1 (reflex::nearest_threat, perfect perception); nullopt:
/// never.
/// @param thresholds  T1 and its tolerance
[[nodiscard]] std::optional<double> trigger_time(const scenario::Scenario& scenario,
                                                 const manoeuvre::Car& car,
                                                 const reflex::Thresholds& thresholds = {});

using encounter::DecisionPoint;

/// What follows from that instant on; nullopt: SACA's trigger never fires. The scenario outlives
/// it.
[[nodiscard]] std::optional<DecisionPoint> decision_point_at_trigger(
    const scenario::Scenario& scenario, const manoeuvre::Car& car,
    const reflex::Thresholds& thresholds = {});
std::optional<DecisionPoint> decision_point_at_trigger(
    scenario::Scenario&& scenario, const manoeuvre::Car& car,
    const reflex::Thresholds& thresholds = {}) = delete;

/// The scene as it truly is at a time, among those who are there then.
/// @param time  [s], in [0, scenario.duration]; taken to the nearest 10 ms
[[nodiscard]] world::Scene scene_at(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                                    double time);

/// What follows from one instant: among all who are there then or come later
/// (Stepper::whole_scene). The scenario outlives it.
/// @param time    as scene_at
/// @param chance  what is left to it; none: as written
[[nodiscard]] DecisionPoint decision_point_at(const scenario::Scenario& scenario,
                                              const manoeuvre::Car& car, double time,
                                              const scenario::Chance& chance = {});
DecisionPoint decision_point_at(scenario::Scenario&& scenario, const manoeuvre::Car& car,
                                double time, const scenario::Chance& chance = {}) = delete;

/// encounter::hindsights of the moments that there are, in their places.
[[nodiscard]] std::vector<std::optional<encounter::Hindsights>> tried_from(
    const std::vector<std::optional<DecisionPoint>>& points, const manoeuvre::Car& car,
    const collision::HarmModel& harm, int threads);

}  // namespace saca::eval
