#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "saca/outcome/approach.h"
#include "saca/outcome/outcome.h"

namespace saca::outcome {

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
  [[nodiscard]] const Mover& mover();
  /// When any point of the ego first lies on an edge of the road, if it moves as intended [s].
  [[nodiscard]] std::optional<double> crossing(Side side);
  /// `intended` with poses so far apart, or as it has them where that is nearer, to beyond its end:
  /// what `concatenated` makes of it before a slide with such steps, to the last bit.
  /// @param step  [s], > 0; the same in each call
  [[nodiscard]] const world::Track& in_steps_of(double step);

 private:
  const manoeuvre::EgoMotion& given_;
  const world::Scene& scene_;
  bool goes_on_;
  manoeuvre::EgoMotion carried_on_;
  std::optional<Mover> mover_;
  std::array<std::optional<EdgeApproach>, 2> edges_;  ///< by Side; nullopt: not asked for yet
  std::optional<world::Track> in_steps_;              ///< likewise
};

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
                                    std::span<const Mover*> others)>;

/// As the function of the same name in outcome.h, for one motion of the ego and many of the others.
///
/// @param others    one per actor of the scene, of its footprint
/// @param reaction  none: nobody reacts
/// @throws ContractViolation  if others and actors differ in number
[[nodiscard]] Outcome judge_contacts(PreparedMotion& motion, std::span<const Mover> others,
                                     const HarmModel& harm, const Reaction& reaction = nullptr);

/// Tracks of all actors of a scene with what is worked out of each once. Refer to both.
/// @throws ContractViolation  if tracks and actors differ in number, or a track is not finite
[[nodiscard]] std::vector<Mover> movers_of(const world::Scene& scene,
                                           std::span<const world::Track> tracks);

}  // namespace saca::outcome
