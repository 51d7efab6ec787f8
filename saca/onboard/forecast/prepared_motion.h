#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "saca/onboard/collision/approach.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::forecast {

/// How long an ego that has recovered its lane is followed along it [s]. An assumption: enough to
/// pass what it went around and to see what comes towards it; what is farther off is another
/// encounter.
constexpr double carried_on_for = 2.0;

/// A motion of the ego in a scene, with all that is worked out of it once, however many motions of
/// the others it is held against. Refers to both.
class PreparedMotion {
 public:
  /// @throws ContractViolation  if the motion has no pose or not one velocity and yaw rate for each
  PreparedMotion(const manoeuvre::EgoMotion& motion, const world::Scene& scene);
  PreparedMotion(const PreparedMotion&) = delete;  // `mover` refers to a part of it
  PreparedMotion& operator=(const PreparedMotion&) = delete;

  [[nodiscard]] const world::Scene& scene() const { return scene_; }
  [[nodiscard]] const manoeuvre::EgoMotion& given() const { return given_; }
  /// As given; one that has ended and still moves goes on along the lane at the speed and offset of
  /// its end for `carried_on_for`.
  [[nodiscard]] const manoeuvre::EgoMotion& intended() const {
    return goes_on_ ? carried_on_ : given_;
  }
  /// Of `intended`.
  [[nodiscard]] const collision::Mover& mover();
  /// When any point of the ego first lies on an edge of the road, if it moves as intended [s].
  [[nodiscard]] std::optional<double> crossing(collision::Side side);
  /// `intended` with poses so far apart, or as it has them where that is nearer, to beyond its end:
  /// what `concatenated` makes of it before a slide with such steps, to the last bit.
  /// @param step  [s], > 0; the same in each call
  [[nodiscard]] const world::Track& in_steps_of(double step);

 private:
  const manoeuvre::EgoMotion& given_;
  const world::Scene& scene_;
  bool goes_on_;
  manoeuvre::EgoMotion carried_on_;
  std::optional<collision::Mover> mover_;
  std::array<std::optional<collision::EdgeApproach>, 2>
      edges_;                             ///< by Side; nullopt: not asked for yet
  std::optional<world::Track> in_steps_;  ///< likewise
};

/// Tracks of all actors of a scene with what is worked out of each once. Refer to both.
/// @throws ContractViolation  if tracks and actors differ in number, or a track is not finite
[[nodiscard]] std::vector<collision::Mover> movers_of(const world::Scene& scene,
                                                      std::span<const world::Track> tracks);

}  // namespace saca::forecast
