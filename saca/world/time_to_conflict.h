#pragma once

#include <optional>

#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::world {

/// The ego as it goes on: constant speed along the lane it is in, its lateral offset kept; its
/// heading is that of the lane. At rest it stays.
/// @return  poses at `step` from `scene.time` to `scene.time + horizon`
[[nodiscard]] Track ego_goes_on(const Scene& scene, double horizon, double step);

/// First contact of the ego, going on as it does, with an actor that follows `track`.
///
/// @param horizon  how far to look [s], > 0
/// @return         seconds from scene.time; 0 when they touch now; nullopt when there is none
/// @throws ContractViolation  if the track is empty or the horizon not > 0
[[nodiscard]] std::optional<double> time_to_collision(const Scene& scene, const Actor& actor,
                                                      const Track& track, double horizon);

/// Earliest t at which the ego, going on as it does, covers ground that the actor covers at some t'
/// with |t - t'| <= tolerance. Tolerance 0 is `time_to_collision`.
///
/// @param tolerance  [s], >= 0: 2 s for the preview of crossing traffic, 0.5 s for the trigger
/// @return           seconds from scene.time, exact to 10 ms; nullopt when there is none
[[nodiscard]] std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor,
                                                     const Track& track, double horizon,
                                                     double tolerance);

/// The same without memory or long loops, for the reflex plane: the actor keeps its velocity,
/// acceleration (until rest) and turning rate.
/// Allocates nothing.
[[nodiscard]] std::optional<double> time_to_conflict_now(const Scene& scene, const Actor& actor,
                                                         double horizon, double tolerance) noexcept;

}  // namespace saca::world
