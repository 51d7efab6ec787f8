#pragma once

#include <bitset>
#include <cstdint>
#include <limits>

#include "saca/core/static_vector.h"
#include "saca/preview/threat.h"
#include "saca/world/scene.h"

namespace saca::decide {

/// Which road users are confirmed: seen in two looks of three. A false detection lasts for a look,
/// mostly, and must not set off the trigger by itself; who is there is seen again.
///
/// The M-of-N rule by which trackers begin a track, on top of whatever perception does itself:
/// * A look is a scene in which somebody has been measured anew (`Actor::age` says when), or nobody
///   is there. Who is in a scene without having been measured anew, carried on by a tracker, has
///   not been seen in it.
/// * A name that is new is who it was before, where somebody has gone whose place it is: trackers
///   that change names at every look do not keep anybody from being confirmed.
/// * Who has been confirmed stays so, occluded or not, until three looks have passed without him
///   and he is in the scene no more.
/// * Who is there from the beginning, or after a gap in time, is confirmed: nothing is known of
///   before.
/// * Where looks are farther apart than `longest_wait`, to wait for another costs more than it is
///   worth: who is more likely there than not by perception's own word (`Actor::existence`) is
///   confirmed at once.
/// So a road user who is seen in each look is confirmed one look after the first, 10 ms at 100 Hz
/// and 50 ms at 20 Hz, and never later than `longest_wait` where he is more likely there than not;
/// each look that misses him costs one more.
///
/// Trivially copyable; allocates nothing.
/// Source: Bar-Shalom, Li, Multitarget-Multisensor Tracking: Principles and Techniques, 1995,
/// section 2.5 (logic-based track formation); the figures are ours.
class TrackConfirmation {
 public:
  static constexpr double longest_wait = 0.05;  ///< between two looks [s]
  static constexpr double likely = 0.5;         ///< existence of who is not waited for
  static constexpr double longest_gap = 1.0;    ///< between two scenes: then all begins anew [s]

  /// The next scene.
  void look(const world::Scene& scene) noexcept;

  /// Who of the newest scene is confirmed.
  [[nodiscard]] const preview::ActorSet& confirmed() const noexcept { return confirmed_; }

 private:
  struct Track {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
    std::uint8_t looks = 0;  ///< the last three, the newest lowest; 1: was seen
    bool confirmed = false;
    double measured = 0.0;  ///< when last [s]
    Vec2 p_W;               ///< in the newest scene that he was in [m]
    Vec2 v_W;               ///< likewise [m/s]
    double seen = 0.0;      ///< time of that scene [s]
  };
  static constexpr double never = -std::numeric_limits<double>::infinity();

  [[nodiscard]] Track* named(const world::Actor& actor) noexcept;
  /// Named so, or gone from where this one is now.
  [[nodiscard]] Track* find(const world::Actor& actor, const world::Scene& scene) noexcept;
  [[nodiscard]] bool is_look(const world::Scene& scene) noexcept;

  StaticVector<Track, 2 * world::max_actors> tracks_;  ///< who is there, and who was lately
  preview::ActorSet confirmed_;
  double newest_ = never;     ///< scene [s]
  double looked_at_ = never;  ///< time of the newest look [s]
};

}  // namespace saca::decide
