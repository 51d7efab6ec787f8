#pragma once

#include <cstdint>
#include <optional>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"

namespace saca::world {

/// How the ego is taken to go on.
enum class EgoPrediction : std::uint8_t {
  in_lane,      ///< constant speed along its lane, its lateral offset kept, its heading that of the
                ///< lane: what remains where its driver stops braking or steering
  as_measured,  ///< on the arc of its measured course and yaw rate, with its measured deceleration
                ///< until it is at rest. It does not speed up
};

/// The ego going on as it does, `after` seconds from scene.time.
///
/// As measured, only what is beyond the band of ordinary lane keeping, coasting and noise counts:
/// deceleration beyond 0.5 m/s^2, speed across the lane beyond 0.5 m/s, and acceleration across it
/// beyond 0.5 m/s^2. Within the bands both predictions are the same, and between them there is no
/// jump. Below 0.1 m/s, and backwards, it is `in_lane`. Good for a second or two: nobody holds a
/// turn longer.
[[nodiscard]] Pose ego_going_on(const Scene& scene, double after,
                                EgoPrediction prediction = EgoPrediction::in_lane);

/// The actor going on as it does, `after` seconds from scene.time: it keeps the arc that its
/// velocity and turning rate describe, and its acceleration along it until it is at rest. Actors
/// below 0.1 m/s stay where they are.
[[nodiscard]] Pose actor_going_on(const Actor& actor, double after);

/// The actor crosses the road: it moves, and its course differs by 30 to 150 deg from that of the
/// lane where it is.
[[nodiscard]] bool is_crossing(const Scene& scene, const Actor& actor);

/// The actor's whole body is behind the ego's along the lane, and it does not cross the road:
/// braking and swerving for it would be wrong.
[[nodiscard]] bool is_behind(const Scene& scene, const Actor& actor);

/// A vehicle that drives (0.5 m/s at least) behind, in the ego's own path: what becomes of it
/// depends on how it reacts to the ego.
[[nodiscard]] bool is_follower(const Scene& scene, const Actor& actor);

/// First contact of the ego, going on in its lane, with an actor that follows `track`.
///
/// @param horizon  how far to look [s], > 0
/// @return         seconds from scene.time, exact to 10 ms (a shorter touch may be missed); 0 when
///                 they touch now; nullopt when there is none
/// @throws ContractViolation  if the track is empty or the horizon not > 0
[[nodiscard]] std::optional<double> time_to_collision(const Scene& scene, const Actor& actor,
                                                      const Track& track, double horizon);

/// Earliest t at which the ego, going on in its lane, covers ground that the actor covers at some
/// t' with |t - t'| <= tolerance, if the actor is crossing (now); other traffic has no tolerance,
/// which is `time_to_collision`: a follower drives, two seconds later, where the ego is now.
///
/// @param tolerance  of crossing traffic [s], >= 0
/// @return           seconds from scene.time, exact to 10 ms (a shorter touch may be missed);
///                   nullopt when there is none
[[nodiscard]] std::optional<double> time_to_conflict(const Scene& scene, const Actor& actor,
                                                     const Track& track, double horizon,
                                                     double tolerance);

/// The same for an actor that goes on as it does, and either prediction of the ego. Allocates
/// nothing: for the reflex plane.
[[nodiscard]] std::optional<double> time_to_conflict(
    const Scene& scene, const Actor& actor, double horizon, double tolerance,
    EgoPrediction prediction = EgoPrediction::in_lane);

}  // namespace saca::world
