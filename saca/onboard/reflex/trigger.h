#pragma once

#include <bitset>
#include <cstddef>
#include <optional>

#include "saca/base/world/scene.h"
#include "saca/base/world/time_to_conflict.h"

namespace saca::reflex {

/// When SACA wakes and when it acts: the paper's T1 and T2, and how near in time two paths must
/// cross to count.
struct Thresholds {
  double trigger = 1.3;            ///< T1 [s]
  double preview = 5.5;            ///< T2 [s]
  double trigger_tolerance = 0.5;  ///< of crossing traffic at the trigger [s]
  double preview_tolerance = 2.0;  ///< of crossing traffic at the preview [s]
  double least_posterior = 0.05;   ///< intentions below this do not start a preview [-]
  /// Before T1, SACA acts as soon as it is expected to cost more harm than this to wait for two
  /// more looks, by two verdicts running. Fitted (docs/decisions/0025). nullopt: never before T1,
  /// as in the paper.
  std::optional<double> waiting_cost = 0.003;
  /// So long before a conflict, and no earlier, it leaves the lane before T1 [s]: who comes over
  /// may still go back, and braking can be taken back. Fitted (docs/decisions/0026).
  double earliest_swerve = 2.5;
};

/// An actor that the ego is in conflict with.
struct Threat {
  std::size_t actor = 0;  ///< index into scene.actors
  double time = 0.0;      ///< to the conflict [s], >= 0
};

/// Some of a scene's actors, by index.
using ActorSet = std::bitset<world::max_actors>;
constexpr ActorSet all_actors{~0ULL};

/// The nearest conflict in time within `horizon` if all go on as they do. Who is behind is no
/// threat.
/// @param tolerance  of crossing traffic [s]; other traffic has none
/// @param who        nobody else is looked at
/// Allocates nothing: for the reflex plane.
[[nodiscard]] std::optional<Threat> nearest_threat(
    const world::Scene& scene, double horizon, double tolerance,
    world::EgoPrediction ego = world::EgoPrediction::in_lane, const ActorSet& who = all_actors);

/// The nearest conflict within T2, the ego going on as it is measured to, so that a driver who
/// already brakes or steers enough is left alone: what may become the trigger. Allocates nothing.
/// @param who  nobody else is looked at
[[nodiscard]] std::optional<Threat> measured_threat(const world::Scene& scene,
                                                    const Thresholds& thresholds,
                                                    const ActorSet& who = all_actors);

/// The conflict that sets off the trigger: measured_threat where it is within T1. nullopt: none
/// does now. The one rule of the reflex plane and of everybody who is compared with it. Allocates
/// nothing.
/// @param who  nobody else is looked at
[[nodiscard]] std::optional<Threat> triggering_threat(const world::Scene& scene,
                                                      const Thresholds& thresholds,
                                                      const ActorSet& who = all_actors);

}  // namespace saca::reflex
