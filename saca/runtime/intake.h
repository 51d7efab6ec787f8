#pragma once

#include <optional>

#include "saca/world/scene.h"

namespace saca::runtime {

/// What an intake made of what came.
struct Taken {
  bool usable = false;     ///< `Intake::scene()` can be decided by
  bool degraded = false;   ///< somebody or everything in it is carried on instead of seen
  bool new_drive = false;  ///< the first scene, or time jumped: what was known says nothing
};

/// Makes of what perception delivers scenes that break no rule of world::broken_rule, whatever
/// comes.
///
/// * An actor that breaks a rule, or a second one of its name, is left out. Who was there before
///   and cannot be used now is carried on as it moved, with growing spread, for `longest_carried`.
/// * Where the ego, the road or the grip break a rule, or no scene came at all, everything is
///   carried on for as long, the ego as it moves now: braking and turning.
/// * A scene that comes late, older than the newest by at most `longest_gap`, is left aside. Time
///   that jumps by more, ahead or back, begins a new drive.
/// Allocates nothing, never throws.
class Intake {
 public:
  static constexpr double longest_carried = 0.5;  ///< [s]
  static constexpr double longest_gap = 1.0;      ///< [s]

  /// A scene came.
  Taken take(const world::Scene& scene) noexcept;
  /// None came until `now` [s], in the scenes' time.
  Taken carry_on(double now) noexcept;

  /// The newest that can be used.
  [[nodiscard]] const world::Scene& scene() const noexcept { return scene_; }

 private:
  world::Scene scene_;
  std::optional<double> seen_at_;  ///< when a scene last came whose frame was right [s]
  double delivered_ = 0.0;         ///< time of the last one that came [s]
};

}  // namespace saca::runtime
