#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "saca/base/world/footprint.h"
#include "saca/base/world/scene.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::eval {

/// How far from its ends a recorded motion is known as well as in its middle, where it is smoothed
/// with samples on both sides.
struct Settling {
  /// From the first sample on [s], >= 0: importers::smooth_track fits over +-0.7 s, then over +-0.5
  /// s, and accelerations are differenced over 0.5 s (sim::Traffic).
  double after_start = 1.7;
  double before_end = 1.2;  ///< until the last [s], >= 0
};

/// Is what an actor does at this instant known so well? Who has no recording always is; who is
/// recorded from the scenario's beginning on was recorded before it.
/// @param time  of the actor's own [s] (scenario::own_time)
[[nodiscard]] bool is_settled(const scenario::ScenarioActor& actor, double time,
                              const Settling& settling);

/// Which part of a recorded drive counts.
struct ShadowWindow {
  double from = 0.0;            ///< [s]; before, SACA looks on but nothing counts
  std::optional<double> until;  ///< of normal driving [s]; nullopt: as long as the ego was recorded
  /// How far the road of the scenario is the road that was there, along its lane [m]. From the look
  /// on at which the ego gets within T1 of there, or drives 20 deg or more across the lane as who
  /// turns off does, nothing counts any more: SACA's world is a lane of one curvature, and beyond
  /// there is another. nullopt: all the way.
  std::optional<double> lane_ahead;
  Settling settling;  ///< of the others
};

/// What a trigger is judged by.
enum class ShadowReason : std::uint8_t {
  driver_braked,   ///< danger
  driver_steered,  ///< danger
  track_ends,      ///< false: who threatens was only just, or not much longer, recorded
  other_braked,    ///< danger
  crash,           ///< danger: after normal driving they touch
  bodies_touch,    ///< false: the recorded bodies overlap, which is an error of the recording
  braking_needed,  ///< danger
  nothing_needed,  ///< false
};
/// "driver_braked".
[[nodiscard]] std::string_view name(ShadowReason reason);
[[nodiscard]] std::optional<ShadowReason> shadow_reason_from(std::string_view name);
/// In words, for people: "the driver braked with 4 m/s^2 or more".
[[nodiscard]] std::string_view meaning(ShadowReason reason);
[[nodiscard]] bool is_danger(ShadowReason reason);

/// What was recorded around a trigger, and what it says.
struct ShadowJudgement {
  double driver_deceleration = 0.0;           ///< hardest, size [m/s^2], >= 0
  double other_deceleration = 0.0;            ///< likewise, of who threatens
  double driver_lateral_acceleration = 0.0;   ///< largest against the lane, size [m/s^2], >= 0
  std::optional<double> needed_deceleration;  ///< size [m/s^2], >= 0; nullopt: none of up to 12 is
                                              ///< enough
  double least_gap = 0.0;  ///< between the bodies, while both are recorded [m]; 0: they touch
  ShadowReason reason = ShadowReason::nothing_needed;
};

/// How hard braking is more than normal driving: size [m/s^2]; see judged.
constexpr double hard_braking = 4.0;
/// How hard steering across the lane is: size [m/s^2].
constexpr double hard_steering = 3.0;
/// How long a recording is looked at from a trigger on [s].
constexpr double judged_for = 3.0;

/// Which actor of the scenario is perceived.
/// @throws ContractViolation  if there is none of that kind and id
[[nodiscard]] std::size_t actor_index(const scenario::Scenario& scenario,
                                      const world::Actor& actor);

/// Judges a trigger of a recorded drive: was there danger, or would SACA have acted without need?
///
/// The rule looks at the recording from the trigger on for 3 s (what lies beyond its end goes on
/// straight). The trigger is danger if
///  1. the driver braked with 4 m/s^2 or more, over half a second that begins at most half a second
///     before the trigger;
///  2. or steered: 3 m/s^2 or more across the lane, over a second;
///  3. or whoever threatens braked as hard as 1;
///  4. or, nobody having done so, the driver needed to: on the way that he took, going on at the
///     speed he had, only a deceleration of 4 m/s^2 or more, begun at the trigger, would have kept
///     the bodies apart, the other moving as recorded.
/// Else it is false. What is only an error of the recording is reported as such and counts as
/// false, so that the rate of false triggers is none too low: after 2, who threatens was only just
/// recorded (unless from the scenario's beginning on), or not much longer, by `Settling`; before 4,
/// the bodies touch though driving is normal. Where they touch after it, that is a crash, and
/// danger.
///
/// Why so. 4 m/s^2 lies above what people call normal: the deceleration needed to avoid a crash is
/// a conflict from 3.35 m/s^2 on (Archer 2005), adaptive cruise controls may use 3.5 at speed (ISO
/// 15622); up to 5 UN R157 sees no emergency. Smoothing blunts the hardest braking over 0.7 s. 3
/// m/s^2 is what UN R79 lets a lane-keeping car use at most; a lane change of 3.5 m in 5 s has 0.8.
/// Neither the gap nor the time to collision decides: in a queue people roll to within a metre of
/// each other, with less than a second to go, and need 1 m/s^2; who trigger there is a nuisance.
/// What the driver needed is measured in hindsight, with what the other then did and the way the
/// driver was on: who was about to leave the lane needed nothing.
///
/// @param ego    body about its centre of mass
/// @param actor  who threatens: index into scenario.actors; it does not react
/// @param time   of the trigger, within the ego's recording [s]
/// @param window  its `until` and `settling` count
/// @throws ContractViolation  if the ego has no recording, or there is no such actor
[[nodiscard]] ShadowJudgement judged(const scenario::Scenario& scenario,
                                     const world::Footprint& ego, std::size_t actor, double time,
                                     const ShadowWindow& window = {});

}  // namespace saca::eval
