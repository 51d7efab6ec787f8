#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/edge.h"
#include "saca/onboard/collision/face.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::collision {

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

/// Slower than this a body rests [m/s].
constexpr double at_rest = 0.05;

/// Does the ego still move where its motion ends (faster than `at_rest`)? Who does and has ended,
/// goes on along the lane for two seconds more.
[[nodiscard]] bool moves_at_end(const manoeuvre::EgoMotion& motion);

}  // namespace saca::collision
