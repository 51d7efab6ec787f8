#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "saca/core/static_vector.h"
#include "saca/manoeuvre/drive.h"
#include "saca/outcome/edge.h"
#include "saca/outcome/face.h"
#include "saca/outcome/harm.h"
#include "saca/outcome/ordering.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::outcome {

/// A touch of the ego with somebody or with what stands beyond the road's edge.
struct Contact {
  double time = 0.0;                 ///< exact to 0.1 ms [s]
  std::optional<std::size_t> actor;  ///< index into scene.actors; nullopt: the edge of the road
  std::optional<Side> edge;          ///< of the road, when it is no actor
  Face ego_face = Face::front;
  Face other_face = Face::front;  ///< meaningless at an edge
  Vec2 p_W;                       ///< where they touch; of flat faces the middle [m]
  Vec2 n_W;                       ///< unit normal there, from the ego outwards
  Vec2 v_rel_W;                   ///< velocity of the other's centre minus that of the ego's [m/s]
  double relative_speed = 0.0;    ///< size of v_rel_W [m/s]
  double ego_delta_v = 0.0;       ///< [m/s], >= 0
  double other_delta_v = 0.0;     ///< [m/s], >= 0
  double ego_spin = 0.0;          ///< change of the ego's yaw rate [rad/s]
  double other_spin = 0.0;        ///< likewise of the other
};

/// Further contacts that are told one by one.
constexpr std::size_t max_later = 3;

/// Distances beyond this are not told apart [m].
constexpr double far_away = 100.0;

/// Does what stands beyond an edge end the ego's motion? Kerbs and open ground do not.
[[nodiscard]] bool stops_the_ego(world::Beyond beyond);

/// Whom or what the ego passes nearest, and when.
struct Nearest {
  std::optional<std::size_t> actor;  ///< index into scene.actors; nullopt: an edge of the road
  std::optional<Side> edge;          ///< of the road, when it is no actor
  double time = 0.0;                 ///< [s]
};

/// What a manoeuvre ends in.
struct Outcome {
  std::optional<Contact> contact;          ///< the first
  StaticVector<Contact, max_later> later;  ///< what followed it, in order of time
  double collision_loss = 0.0;  ///< the paper's, of the first contact: relative speed x 0.41 side,
                                ///< 0.35 front, 0.21 rear
  double harm = 0.0;  ///< of all contacts: expected severely injured and killed people, weighted:
                      ///< data/harm.toml
  double clearance = far_away;  ///< smallest distance to anybody or an edge with something beyond,
                                ///< at most `far_away`; 0 with contact [m]
  std::optional<Nearest> nearest;  ///< at `clearance`; nullopt with contact, and at `far_away`
  double end_time = 0.0;           ///< when the ego came to rest, or its motion ended [s]
};

/// How the others move when the ego moves so: one track per actor of the scene, in its order.
/// Before its track starts an actor is not there.
/// Whoever reacts answers to the ego's motion up to each instant only, so that motions which agree
/// up to a time have tracks which agree up to it.
using Others = std::function<std::vector<world::Track>(const manoeuvre::EgoMotion& ego)>;

/// A story to its end.
struct CollisionSequence {
  Outcome outcome;
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
/// rest (outcome/slide.h), and so does whoever it met. What they meet on the way is met in the same
/// manner. Kerbs and open ground do not stop the ego: crossing such an edge does once the harm that
/// data/harm.toml states. A barrier throws it back; trees hold it. Others do not meet each other,
/// and somebody outside a vehicle is struck only once.
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
                                                   const world::Scene& scene, const Others& others,
                                                   const HarmModel& harm, double grip);
/// Struck bodies slide on the scene's grip.
[[nodiscard]] CollisionSequence collision_sequence(const manoeuvre::EgoMotion& motion,
                                                   const world::Scene& scene, const Others& others,
                                                   const HarmModel& harm);

/// The outcome of `collision_sequence`.
[[nodiscard]] Outcome judge(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                            const Others& others, const HarmModel& harm);
/// The others follow fixed tracks until they are struck; before its track starts an actor is not
/// there.
/// @param tracks  one per actor of the scene, in its order; each may be shorter than the motion
[[nodiscard]] Outcome judge(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                            std::span<const world::Track> tracks, const HarmModel& harm);
[[nodiscard]] Outcome judge(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                            std::span<const world::Track> tracks, const HarmModel& harm,
                            double grip);

/// Does the ego still move where its motion ends (more than 0.05 m/s)? Who does and has ended, goes
/// on along the lane for two seconds more.
[[nodiscard]] bool moves_at_end(const manoeuvre::EgoMotion& motion);

/// As `judge`, for forecasts: the clearance is not looked for and 0, struck bodies slide in coarser
/// steps (coarse_slide), and bodies that stay together are looked at every 50 ms instead of 10.
[[nodiscard]] Outcome judge_contacts(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                                     const Others& others, const HarmModel& harm);
[[nodiscard]] Outcome judge_contacts(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                                     std::span<const world::Track> tracks, const HarmModel& harm);

}  // namespace saca::outcome
