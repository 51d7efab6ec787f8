#pragma once

#include <cstddef>

#include "saca/base/world/track.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::scenario {

/// Whether an actor reacts to others, so that it has no motion of its own: see Traffic.
[[nodiscard]] bool reacts(const ScenarioActor& actor);

/// Where an actor is when the scenario begins, or where it appears.
/// @param actor  index into scenario.actors
[[nodiscard]] Pose start_pose(const Scenario& scenario, std::size_t actor);

/// When an actor appears: 0, or the time of its first sample. Before, it is not there [s].
[[nodiscard]] double appears_at(const Scenario& scenario, std::size_t actor, const Chance& chance);

/// An actor's own time: it runs through its motion faster or slower from `from` on [s].
[[nodiscard]] double own_time(double time, const ActorChance& chance, double from);

/// Where an actor that does not react is, under one draw of chance.
///
/// @param time  [s], >= 0; before it appears it stands where it will
/// @throws ContractViolation  if it reacts, or there is no such actor
///
/// A recording is interpolated. After its end the actor goes on straight at its last speed; slower
/// than 0.3 m/s counts as stopped. Who walks stops, or starts to run, with 3 m/s^2 (an assumption).
[[nodiscard]] Pose actor_pose(const Scenario& scenario, std::size_t actor, double time,
                              const Chance& chance);

/// The true motion of an actor that does not react, over the whole scenario.
/// @param step  [s], > 0
/// @return      from when it appears to scenario.duration
[[nodiscard]] world::Track actor_track(const Scenario& scenario, std::size_t actor, double step,
                                       const Chance& chance = {});

/// How steeply a lane change crosses the lane where it does so most: its way aside per way ahead
/// [-].
[[nodiscard]] double steepest_slope(const Script& script);

/// The ego as the scenario gives it, before anyone else drives: recorded, or going on at constant
/// speed along its lane. After the end of its recording it goes on straight at its last speed.
/// @param time  [s], >= 0
[[nodiscard]] world::EgoState ego_at(const Scenario& scenario, double time);

}  // namespace saca::scenario
