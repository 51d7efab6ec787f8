#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/core/vec2.h"
#include "saca/base/world/scene.h"

namespace saca::match {

// What of a scene matters to the choice of a manoeuvre, seen from the ego along its lane: s ahead,
// d to the left. Formula and scales, and how they were fitted: docs/decisions/0029-experience.md.

/// The ego and its road.
struct EgoFeatures {
  bool usable = false;  ///< false for a scene that breaks a rule: it is like no other
  Vec2 v_L;             ///< over ground [m/s]
  double offset = 0.0;  ///< d of the centre of mass [m]
  double heading = 0.0;
  double yaw_rate = 0.0;
  double length = 0.0;
  double width = 0.0;
  double log_grip = 0.0;
  double lane_width = 0.0;
  double curve = 0.0;  ///< acceleration that following the lane takes [m/s^2], > 0 to the left
  double to_left_edge = 0.0;   ///< from the centre of mass to the edge, at most 7 m
  double to_right_edge = 0.0;  ///< likewise
  world::Topology topology = world::Topology::straight;
  world::Beyond left_beyond = world::Beyond::unmarked;
  world::Beyond right_beyond = world::Beyond::unmarked;
  bool oncoming_left = false;
  bool oncoming_right = false;
};

/// One actor.
struct ActorFeatures {
  Vec2 p_rel_L;           ///< (s, d) along the lane, minus the ego's [m]
  Vec2 v_rel_L;           ///< likewise [m/s]
  double sideways = 0.0;  ///< its acceleration across the lane [m/s^2]
  Vec2 forward_L;         ///< unit vector of its heading
  double length = 0.0;
  double width = 0.0;
  double threat = 0.0;  ///< the difference that its absence makes, in [0, 4]
  world::ActorKind kind = world::ActorKind::car;
};

struct Features {
  EgoFeatures ego;
  StaticVector<ActorFeatures, world::max_actors> actors;
};

/// Allocates nothing.
[[nodiscard]] Features features(const world::Scene& scene) noexcept;

/// What, alone, makes a difference of 1. Fitted (`saca memory calibrate --fit`), but for those
/// marked assumed: in the encounters that they were fitted to, these hardly differ.
struct Scales {
  double speed = 0.7;  ///< of the ego, along the lane [m/s]
  double log_grip = 0.15;
  double sideways = 1.0;    ///< of the ego, across [m/s], assumed
  double offset = 1.0;      ///< of the ego in its lane [m], assumed
  double heading = 0.2;     ///< [rad], assumed
  double yaw_rate = 0.3;    ///< [rad/s], assumed
  double ego_size = 2.0;    ///< [m], assumed
  double lane_width = 1.0;  ///< [m], assumed
  double curve = 2.0;       ///< [m/s^2], assumed
  double to_edge = 3.0;     ///< of the ways to both edges [m]
  // Of an actor. Where it will be across the lane in 1 s counts most: it hits or misses.
  double along_now = 6.0;      ///< [m]
  double across_now = 4.0;     ///< [m]
  double across_then = 0.7;    ///< in 1 s, at constant velocity [m]
  double along_then = 8.0;     ///< in 2 s, likewise [m]
  double speed_along = 3.5;    ///< [m/s]
  double speed_across = 4.5;   ///< [m/s]
  double acceleration = 1.25;  ///< across the lane [m/s^2]
  double edge = 0.6;           ///< of half its length or width [m]
  double turned = 4.0;         ///< of the ends of its body [m]
  double absence = 0.75;       ///< share of its threat that its absence makes
};

/// Parts of what is compared of the ego and its road, each divided by its scale.
enum EgoPart : std::size_t {
  ego_speed,
  ego_sideways,
  ego_offset,
  ego_heading,
  ego_yaw_rate,
  ego_length,
  ego_width,
  ego_grip,
  ego_lane_width,
  ego_curve,
  ego_to_left_edge,
  ego_to_right_edge,
};
constexpr std::size_t num_ego_parts = 12;

/// As they are compared: a difference of 1 in a part makes a difference of 1.
template <class Real>
struct ScaledEgo {
  std::array<Real, num_ego_parts> parts{};  ///< by EgoPart
  /// How much of what lies beyond an edge matters: 1 within a lane's width, 0 where it is far away.
  Real near_left = 0;
  Real near_right = 0;
  Real half_turn = 0;  ///< in units of its heading
  world::Topology topology = world::Topology::straight;
  bool usable = false;
  bool hard_left = false;  ///< a barrier or trees beyond the edge
  bool hard_right = false;
  bool oncoming_left = false;
  bool oncoming_right = false;
};

/// Likewise an actor.
template <class Real>
struct ScaledActor {
  /// Two along the lane, two across it, `sideways`, half of each size, 0.
  std::array<Real, 8> parts{};
  Real arm = 0;  ///< half of what turning moves
  Real forward_s = 1;
  Real forward_d = 0;
  Real absence2 = 0;  ///< square of the difference that its absence makes
  world::ActorKind kind = world::ActorKind::car;
};

template <class Real>
using ScaledActors = StaticVector<ScaledActor<Real>, world::max_actors>;

/// As float they are half as large, and compared twice as fast; differences are then good to six
/// digits. Defined for float and double.
template <class Real>
[[nodiscard]] ScaledEgo<Real> scaled(const EgoFeatures& ego, const Scales& scales = {}) noexcept;
template <class Real>
[[nodiscard]] ScaledActors<Real> scaled(std::span<const ActorFeatures> actors,
                                        const Scales& scales = {}) noexcept;

/// The part of the square of a difference that is due to another kind of road or other markings.
template <class Real>
[[nodiscard]] Real road_difference2(const ScaledEgo<Real>& a, const ScaledEgo<Real>& b) noexcept;

/// Square of `difference`.
/// @param limit2  where the caller stops caring: any number >= limit2 may come back instead of a
///                larger one
template <class Real>
[[nodiscard]] Real difference2(const ScaledEgo<Real>& ego_a,
                               std::span<const ScaledActor<Real>> actors_a,
                               const ScaledEgo<Real>& ego_b,
                               std::span<const ScaledActor<Real>> actors_b, Real limit2) noexcept;

/// How far apart two scenes are: the root of a sum of squares over the ego, its road and the
/// actors, under the assignment of one scene's actors to the other's that makes it smallest. Who
/// stays unmatched counts by the threat that it is.
///
/// The scales are such that what policies are expected to harm in like scenes, weighted by
/// exp(-difference^2 / 2), predicts best what they are expected to harm in this one.
///
/// @param limit  where the caller stops caring: any number >= limit may come back instead of a
///               larger one
/// @return       >= 0, 0 for the same scene; infinite when one of them is not usable
///
/// Symmetric to the last bit. Exact for any number of actors; allocates nothing.
[[nodiscard]] double difference(const EgoFeatures& ego_a, std::span<const ActorFeatures> actors_a,
                                const EgoFeatures& ego_b, std::span<const ActorFeatures> actors_b,
                                double limit = std::numeric_limits<double>::infinity()) noexcept;

/// A part of a difference.
struct DifferencePart {
  std::string what;   ///< "speed", "grip", "car1 for van2", "nobody for pedestrian1"
  double size = 0.0;  ///< > 0; the root of the sum of their squares is the difference
};

/// What two scenes differ in, the largest first: for people.
/// @throws ContractViolation  if one of them breaks a rule of `world::broken_rule`
[[nodiscard]] std::vector<DifferencePart> difference_parts(const world::Scene& a,
                                                           const world::Scene& b);

/// 0.9 to the power of the difference: 1 at 0, 0.9 at 1, 0.7 at 3.4.
[[nodiscard]] double similarity_at(double difference) noexcept;

/// How alike two scenes are for the choice of a manoeuvre, in [0, 1]; 1 for the same scene seen
/// from any world frame. How often a plan transfers is told by Experience::recall. 0 when either
/// breaks a rule of `world::broken_rule`. Allocates nothing; whoever compares one scene with many
/// keeps its features.
[[nodiscard]] double similarity(const Features& a, const Features& b) noexcept;
[[nodiscard]] double similarity(const world::Scene& a, const world::Scene& b) noexcept;

}  // namespace saca::match
