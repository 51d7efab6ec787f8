#pragma once

#include <functional>
#include <span>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/forecast/prepared_motion.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::rollout {

/// A story to its end.
struct CollisionSequence {
  collision::Outcome outcome;
  manoeuvre::EgoMotion ego;          ///< as intended until it is struck, then sliding to rest
  std::vector<world::Track> others;  ///< likewise, one per actor of the scene
};

/// Everything that comes of a motion, until all that matters rests.
///
/// @param others  asked at the start, and again after each impact with what the ego then really
/// does
/// @param grip    true friction coefficient, on which struck bodies slide
/// @throws ContractViolation  if tracks and actors differ in number, or the motion has no pose or
/// not
///                            one velocity and yaw rate for each
///
/// The ego moves as intended until the first contact that does not let it go on; then it slides to
/// rest (rollout/slide.h), and so does whoever it met. What they meet on the way is met in the same
/// manner. Kerbs and open ground do not stop the ego: crossing such an edge does once the harm that
/// data/harm.toml states. A barrier throws it back; trees hold it. collision::Others do not meet
/// each other, and somebody outside a vehicle is struck only once.
///
/// Two bodies that have met are left alone for the tenth of a second that a collision lasts; after
/// that they meet again where they touch and approach each other with more than 0.1 m/s. Bodies
/// that stay together, pushing or resting, are thus not struck again and again.
///
/// Invariant to the world frame and mirror-symmetric. Bodies that overlap at the start are in
/// contact then.
///
/// When the motion has `ended`: an ego at rest stays there until the last track ends, since it can
/// still be run into, also after it was struck; one that has recovered a lane goes on along it for
/// 2 s. An actor that still moves when its track ends is not looked at beyond that.
///
/// The contact with an edge that does not stop the ego is the first only when nothing else follows.
///
/// Harm: the chances that each person comes out of every impact unhurt multiply, for severe injury
/// and for death. An actor's `existence` scales the harm of meeting it and of all that
/// follows, and nothing else.
[[nodiscard]] CollisionSequence collision_sequence(const manoeuvre::EgoMotion& motion,
                                                   const world::Scene& scene,
                                                   const collision::Others& others,
                                                   const collision::HarmModel& harm, double grip);
/// Struck bodies slide on the scene's grip.
[[nodiscard]] CollisionSequence collision_sequence(const manoeuvre::EgoMotion& motion,
                                                   const world::Scene& scene,
                                                   const collision::Others& others,
                                                   const collision::HarmModel& harm);

/// The outcome of `collision_sequence`.
[[nodiscard]] collision::Outcome judge(const manoeuvre::EgoMotion& motion,
                                       const world::Scene& scene, const collision::Others& others,
                                       const collision::HarmModel& harm);
/// The others follow fixed tracks until they are struck; before its track starts an actor is not
/// there.
/// @param tracks  one per actor of the scene, in its order; each may be shorter than the motion
[[nodiscard]] collision::Outcome judge(const manoeuvre::EgoMotion& motion,
                                       const world::Scene& scene,
                                       std::span<const world::Track> tracks,
                                       const collision::HarmModel& harm);
[[nodiscard]] collision::Outcome judge(const manoeuvre::EgoMotion& motion,
                                       const world::Scene& scene,
                                       std::span<const world::Track> tracks,
                                       const collision::HarmModel& harm, double grip);

/// As `judge`, for forecasts: the clearance is not looked for and 0, struck bodies slide in coarser
/// steps (coarse_slide), and bodies that stay together are looked at every 50 ms instead of 10.
[[nodiscard]] collision::Outcome judge_contacts(const manoeuvre::EgoMotion& motion,
                                                const world::Scene& scene,
                                                const collision::Others& others,
                                                const collision::HarmModel& harm);
[[nodiscard]] collision::Outcome judge_contacts(const manoeuvre::EgoMotion& motion,
                                                const world::Scene& scene,
                                                std::span<const world::Track> tracks,
                                                const collision::HarmModel& harm);

/// How those others who react move when the ego moves so: called at the start, and again after each
/// impact with what the ego then really does. Up to each instant they answer to the ego's motion up
/// to it only.
///
/// @param X_WB    the ego until it rests, or its motion ends
/// @param struck  one per actor: true of whom the ego has met; how it would else move does not
///                matter any more
/// @param others  likewise: how they move. Those of who reacts are replaced, and refer to what
///                lasts until the next call
using Reaction = std::function<void(const world::Track& X_WB, std::span<const bool> struck,
                                    std::span<const collision::Mover*> others)>;

/// As the function of the same name above, for one motion of the ego and many of the others.
///
/// @param others    one per actor of the scene, of its footprint
/// @param reaction  none: nobody reacts
/// @throws ContractViolation  if others and actors differ in number
[[nodiscard]] collision::Outcome judge_contacts(forecast::PreparedMotion& motion,
                                                std::span<const collision::Mover> others,
                                                const collision::HarmModel& harm,
                                                const Reaction& reaction = nullptr);

}  // namespace saca::rollout
