#pragma once

#include "saca/onboard/collision/outcome.h"

namespace saca::collision {

/// How a body moves at one instant.
struct Instant {
  Pose X_WB;
  Vec2 v_W;               ///< of its origin [m/s]
  double yaw_rate = 0.0;  ///< [rad/s]
};

/// Beyond its end a motion rests.
[[nodiscard]] Instant instant_at(const manoeuvre::EgoMotion& motion, double time);
[[nodiscard]] Instant instant_at(const world::Track& track, double time);

/// What one contact does.
struct Impact {
  Contact contact;
  double loss = 0.0;    ///< the paper's Collision Loss
  Injury ego;           ///< of each of the ego's people
  Injury other;         ///< of each of the other's
  Vec2 ego_change_W;    ///< of the velocity [m/s]
  Vec2 other_change_W;  ///< likewise
  Instant ego_after;
  Instant other_after;
};

/// The ego and an actor meet.
/// @param index  into scene.actors
[[nodiscard]] Impact meet(const world::Scene& scene, std::size_t index, const Instant& ego,
                          const Instant& other, double time, const HarmModel& harm);

/// The ego reaches an edge of the road.
[[nodiscard]] Impact leave(const world::Scene& scene, Side side, const Instant& ego, double time,
                           const HarmModel& harm);

/// One contact in which two vehicles, or the ego and a barrier, press on after the first impact:
/// changes of velocity and turning add up, and hurt as one.
[[nodiscard]] Impact pressed_on(const Impact& first, const Impact& more, const HarmModel& harm);

/// How fast the ego and an actor approach each other where they touch [m/s]; negative when they
/// part.
[[nodiscard]] double closing_speed(const world::Scene& scene, std::size_t index, const Instant& ego,
                                   const Instant& other, const HarmModel& harm);
/// Likewise the ego and what stands beyond an edge.
[[nodiscard]] double closing_speed(const world::Scene& scene, Side side, const Instant& ego,
                                   const HarmModel& harm);

/// What stands beyond an edge.
[[nodiscard]] world::Beyond beyond(const world::Road& road, Side side);

}  // namespace saca::collision
