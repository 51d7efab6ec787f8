#pragma once

#include <optional>

#include "saca/base/world/scene.h"

namespace saca::reflex {

/// What an intake made of what came.
struct IntakeResult {
  bool usable = false;     ///< `Intake::scene()` can be decided by
  bool degraded = false;   ///< somebody or everything in it is carried on instead of seen
  bool new_drive = false;  ///< the first scene, or time jumped: what was known says nothing
};

/// Makes of what perception delivers scenes that break no rule of world::broken_rule, whatever
/// comes.
///
/// * An actor that breaks a rule, or a second one of its name, is left out. Who was there before
///   and cannot be used now is carried on as it moved, with growing spread, for `longest_carried`,
///   unless it would then move as nobody can.
/// * Where the ego, the road or the grip break a rule, or no scene came at all, everything is
///   carried on for as long, the ego as it moves now: braking and turning.
/// * A scene that comes late, older than the newest by at most `longest_gap`, is left aside; one
///   that is newer, but older than what has been carried on to meanwhile, is carried on to there.
///   Time that jumps by more, ahead or back, begins a new drive.
/// Far round a bend the road begins beside the ego, on the same arc: s has no end there then.
/// Its scenes count time from the beginning of the drive, whatever clock perception has: with
/// seconds since 1970 forecasts could not tell their shortest steps apart. Allocates nothing, never
/// throws.
class Intake {
 public:
  static constexpr double longest_carried = 0.5;  ///< [s]
  static constexpr double longest_gap = 1.0;      ///< [s]
  static constexpr double longest_drive = 5e6;    ///< [s]; then a new one begins
  static constexpr double latest = 1e10;          ///< no scene has a later time, or is older [s]

  /// A scene came.
  IntakeResult take(const world::Scene& scene) noexcept;
  /// None came until `now` [s], in the scenes' time.
  IntakeResult carry_on(double now) noexcept;

  /// When this drive began [s], in perception's time.
  [[nodiscard]] double began() const noexcept { return began_; }
  /// The newest that can be used; its time counts from the beginning of the drive.
  [[nodiscard]] const world::Scene& scene() const noexcept { return scene_; }

 private:
  /// Likewise, in time since the drive began.
  IntakeResult carry_on_to(double time) noexcept;
  /// Carries on who was there before and came, but cannot be used.
  void carry_on_unusable(const world::Scene& before, const world::Scene& came) noexcept;
  /// Carries the scene on by `dt` seconds.
  /// @return  false: the ego would break a rule, and nothing has changed
  bool move_on(double dt) noexcept;

  world::Scene scene_;
  double began_ = 0.0;             ///< [s], in perception's time
  std::optional<double> seen_at_;  ///< when a scene last came whose frame was right [s]
  double delivered_ = 0.0;         ///< time of the last one that came [s]
};

}  // namespace saca::reflex
