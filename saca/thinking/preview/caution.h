#pragma once

#include "saca/base/world/scene.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/intent/observer.h"

namespace saca::preview {

/// How others are taken to move in a preview: they differ as recordings show, but who brakes or
/// changes lanes does it as in an emergency: braking 6 m/s^2 built up within 0.3 s, a lane change
/// of 4 s. The three numbers are assumptions. What people usually do (intent::MotionLaw: 2.6 m/s^2
/// within 2 s) is no threat to anybody 2 s behind: nothing would be prepared for a lead that
/// brakes hard.
[[nodiscard]] intent::MotionLaw hard_driving();

/// How likely it is at the least that somebody who moves brakes, whatever is believed.
///
/// Ordinary traffic, which beliefs are learned from, hardly holds anyone who gives way to a car
/// that crosses; near a crash it is more likely. Both numbers are assumptions; with less than
/// Thresholds::least_posterior nobody would be forecast to do so.
struct Caution {
  double crossing = 0.10;  ///< on a course across the road: it may give way [-]
  double other = 0.06;     ///< in conflict within T2 if all go on as they do [-]
};

/// The beliefs that a preview prepares for: where braking, moving aside or not, is less likely than
/// `Caution` has it, as much of everything else gives way to plain braking, or a walker's stop,
/// as is missing, each in proportion.
/// @param beliefs  one per actor
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] intent::Beliefs cautious(const world::Scene& scene, intent::Beliefs beliefs,
                                       const reflex::Thresholds& thresholds,
                                       const Caution& caution = {});

}  // namespace saca::preview
