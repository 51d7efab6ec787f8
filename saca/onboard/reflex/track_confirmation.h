#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::reflex {

/// Which road users are confirmed: seen in two looks of three. A false detection mostly lasts for
/// one look and must not set off the trigger by itself; a road user who is there is seen again.
///
/// This is the M-of-N rule by which trackers begin a track, on top of whatever perception does
/// itself:
/// * A road user is seen where its state has been measured anew (`Actor::age` says when), and
///   missed where it is not in a new scene, or has only been carried on for 0.1 s, the period of
///   the slowest looks. Whatever is carried on for less is neither seen nor missed.
/// * A new name at a place from which another name has gone is the same road user: a tracker that
///   renames everybody at every look does not keep anybody from being confirmed. A name that is
///   suddenly somewhere else, farther than perception can have been wrong, is another road user.
/// * A confirmed road user stays confirmed, occluded or not, until it has not been in the scene for
///   three looks.
/// * Whoever is in the first scene, or in the first after a gap in time, is confirmed: nothing is
///   known of the time before.
/// * A road user that by perception's own word (`Actor::existence`) is more likely there than not
///   waits no longer than `longest_wait`, however seldom it is measured; where looks are farther
///   apart than that, not at all. What perception makes of a look that missed it is for that word
///   to say.
/// So a road user that is seen in every look is confirmed one look after the first: after 10 ms at
/// 100 Hz, 50 ms at 20 Hz, and never later where it is more likely there than not. Each look that
/// misses one who is not costs one more.
///
/// Trivially copyable; allocates nothing.
/// Source: Bar-Shalom, Li, Multitarget-Multisensor Tracking: Principles and Techniques, 1995, on
/// logic-based track formation; the figures are ours.
class TrackConfirmation {
 public:
  static constexpr double longest_wait = 0.05;  ///< of whom perception believes in [s]
  static constexpr double likely = 0.5;         ///< least existence of whom it does not wait for
  static constexpr double longest_gap = 1.0;    ///< between two scenes: then all begins anew [s]

  /// The next scene.
  void look(const world::Scene& scene) noexcept;

  /// Who of the newest scene is confirmed.
  [[nodiscard]] const ActorSet& confirmed() const noexcept { return confirmed_; }

 private:
  struct Track {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
    std::uint8_t looks = 0;   ///< the last three, the newest lowest; 1: seen, 0: missed
    std::uint8_t absent = 0;  ///< looks in a row with it not in the scene
    bool confirmed = false;
    double there_since = 0.0;  ///< in every look since [s]
    double measured = 0.0;     ///< when last [s]
    double looked_at = 0.0;    ///< time of the last of its looks [s]
    Vec2 p_W;                  ///< in the newest scene that it was in [m]
    Vec2 v_W;                  ///< likewise [m/s]
    double position_sd = 0.0;  ///< likewise [m]
    double present = 0.0;      ///< time of that scene [s]
  };
  static constexpr double never = -std::numeric_limits<double>::infinity();

  /// From where it would be if it had gone on as in the last scene that it was in [m].
  [[nodiscard]] static double from_expected(const Track& track, const world::Actor& actor,
                                            double time) noexcept;
  /// Named so, and about where it would be.
  [[nodiscard]] static bool is(const Track& track, const world::Actor& actor, double time) noexcept;
  /// The track that is this actor's, or that has gone from where it is now: index into tracks_.
  [[nodiscard]] std::optional<std::size_t> find(const world::Actor& actor,
                                                const world::Scene& scene) const noexcept;
  [[nodiscard]] bool is_look(const world::Scene& scene) const noexcept;
  /// The track with what the newest scene says of the actor; whether it is confirmed is as it was.
  /// @param known  nullopt: the track begins
  [[nodiscard]] static Track continued(const std::optional<Track>& known, const world::Actor& actor,
                                       const world::Scene& scene) noexcept;

  StaticVector<Track, 2 * world::max_actors> tracks_;  ///< who is there, and who was lately
  ActorSet confirmed_;
  double newest_ = never;     ///< scene [s]
  double looked_at_ = never;  ///< time of the newest look [s]
};

}  // namespace saca::reflex
