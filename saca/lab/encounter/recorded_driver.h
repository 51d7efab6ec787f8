#pragma once

#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::encounter {

/// What a recorded driver did from an instant on, and what it led to.
struct RecordedDriver {
  collision::Outcome outcome;
  std::vector<world::Actor> met;  ///< the actors that outcome.contact counts in
  double braking = 0.0;  ///< hardest deceleration along the lane, over half a second [m/s^2], >= 0
  double aside = 0.0;    ///< farthest from where the driver was across the lane, left positive [m]
};

/// Plays the recording, while everybody concerned was recorded.
/// @param from  [s]
/// @return      nullopt: the ego was not recorded, or for less than 0.1 s from then on
[[nodiscard]] std::optional<RecordedDriver> recorded_driver(const scenario::Scenario& scenario,
                                                            const manoeuvre::Car& car,
                                                            const collision::HarmModel& harm,
                                                            double from);

/// Did the driver brake (2 m/s^2 at least: intent::braking_mark)?
[[nodiscard]] bool brakes(const RecordedDriver& driver);
/// +1, -1: the driver moved by half a metre or more to the left or the right; 0: neither. Half a
/// metre is more than drivers waver in their lane (0.2 m standard deviation) and less than it takes
/// to pass somebody.
[[nodiscard]] int steers(const RecordedDriver& driver);
/// The policy that comes nearest: AEB, a swerve with or without braking to either side, or none.
[[nodiscard]] manoeuvre::PolicyId policy_of(const RecordedDriver& driver);

}  // namespace saca::encounter
