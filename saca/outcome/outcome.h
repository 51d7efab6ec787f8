#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "saca/manoeuvre/drive.h"
#include "saca/outcome/edge.h"
#include "saca/outcome/face.h"
#include "saca/outcome/harm.h"
#include "saca/outcome/ordering.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::outcome {

/// The first touch of the ego with somebody or with what stands beyond the road's edge.
struct Contact {
  double time = 0.0;                 ///< exact to 1 mm of travel [s]
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
};

/// Distances beyond this are not told apart [m].
constexpr double far_away = 100.0;

/// Does what stands beyond an edge end the ego's motion? Kerbs and open ground do not.
[[nodiscard]] bool stops_the_ego(world::Beyond beyond);

/// What a manoeuvre ends in.
struct Outcome {
  std::optional<Contact> contact;
  double collision_loss = 0.0;  ///< the paper's: relative speed x 0.41 side, 0.35 front, 0.21 rear
  double harm = 0.0;  ///< expected severely injured and killed people, weighted: data/harm.toml
  double clearance = far_away;  ///< smallest distance to anybody or an edge with something beyond,
                                ///< at most `far_away`; 0 with contact [m]
  double end_time = 0.0;        ///< of the contact, or when the motion ended [s]
};

/// First contact and its cost when the ego moves as given and the others follow their tracks.
///
/// @param tracks  one per actor of the scene, in its order; each may be shorter than the motion
/// @throws ContractViolation  if tracks and actors differ in number, or the motion has no pose or
/// not
///                            one velocity and yaw rate for each
///
/// Invariant to the world frame and mirror-symmetric. One contact: what follows it is not looked
/// at. Bodies that overlap at the start are in contact then.
///
/// When the motion has `ended`: an ego at rest stays there until the last track ends, since it can
/// still be run into; one that has recovered a lane goes on along it for 2 s. An actor that still
/// moves when its track ends is not looked at beyond that.
///
/// Kerbs and open ground do not stop the ego. Crossing such an edge does the harm that
/// data/harm.toml states and is the contact that is reported only when no other follows; harm is
/// then that of both.
///
/// An actor's `existence` scales the harm of meeting it, and nothing else.
[[nodiscard]] Outcome judge(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                            std::span<const world::Track> tracks, const HarmModel& harm);

/// How the others move when the ego moves so: one track per actor of the scene, in its order.
/// Reacting drivers answer to the ego's motion up to each instant only, so that motions that agree
/// up to a time have tracks that agree up to it.
using Others = std::function<std::vector<world::Track>(const world::Track& X_WB)>;

/// The same when the others react: `others` is asked with the motion as it is judged.
[[nodiscard]] Outcome judge(const manoeuvre::EgoMotion& motion, const world::Scene& scene,
                            const Others& others, const HarmModel& harm);

/// What happens if `plan` is carried out in this scene: full dynamics to rest or a recovered lane.
/// @param grip  true friction coefficient
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                               const world::Scene& scene, std::span<const world::Track> tracks,
                               double grip, const HarmModel& harm);
[[nodiscard]] Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                               const world::Scene& scene, const Others& others, double grip,
                               const HarmModel& harm);

}  // namespace saca::outcome
