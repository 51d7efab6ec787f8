#pragma once

#include <cstdint>
#include <vector>

#include "saca/onboard/manoeuvre/ride.h"

namespace saca::tune {

/// How one manoeuvre ended.
struct Ending {
  Pose X_WB;
  double speed = 0.0;      ///< over ground [m/s]
  double time = 0.0;       ///< since its start [s]
  bool ended = false;      ///< false: the horizon came first
  std::vector<Pose> path;  ///< X_WB every 50 ms from the start to the end; empty unless asked for
};

/// Rides to the end of the manoeuvre or for `horizon` [s], whichever comes first. `path` stays
/// empty.
[[nodiscard]] Ending ride_to_end(manoeuvre::Ride ride, double horizon);
/// The same, with its path.
[[nodiscard]] Ending ride_along_path(manoeuvre::Ride ride, double horizon);

/// How often a manoeuvre is driven, and on what.
struct EndingDraws {
  double grip = 0.0;     ///< true friction coefficient before it is drawn [-]
  double horizon = 0.0;  ///< longest time of one [s]
  int count = 0;
  std::uint64_t seed = 1;
  int with_paths = 0;  ///< of how many, from the first on, the path is kept
  int threads = 1;     ///< they do not change the result
};

/// The same manoeuvre so many times, with what its controller does not know drawn anew.
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] std::vector<Ending> draw_endings(const manoeuvre::Car& car,
                                               const manoeuvre::Plan& plan,
                                               const world::Scene& scene, const EndingDraws& draws);

/// How many of a T-drift's endings are at rest within 10 deg of across the lane.
[[nodiscard]] int num_across(const std::vector<Ending>& endings, const manoeuvre::Plan& plan,
                             const world::Road& road);

}  // namespace saca::tune
