#pragma once

#include <vector>

#include "saca/intent/intention.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::intent {

/// How people really drive under an intention, and how far they differ in it. The numbers here are
/// assumptions; a `Model` brings those of recordings.
struct MotionLaw {
  double acceleration_sd = 0.3;  ///< of those who maintain: it wavers so much about 0 [m/s^2]
  double acceleration_time =
      1.0;                      ///< over which it does: its correlation is exp(-t / this) [s], > 0
  double braking = 6.0;         ///< of one who does not brake yet: median [m/s^2], > 0
  double braking_log_sd = 0.3;  ///< standard deviation of its logarithm [-]
  double braking_rise = 0.3;    ///< until such a braking has built up, linearly [s], >= 0
  double held_log_sd = 0.15;  ///< of one who brakes: of the logarithm of what it goes on with over
                              ///< what is measured now [-]
  double lane_change = 4.0;   ///< from lane to lane: median [s], > 0
  double lane_change_log_sd = 0.4;  ///< standard deviation of its logarithm [-]
};

/// How far a road user may be from where it is forecast: standard deviations [m], along its line
/// and across.
struct Spread {
  double along_sd = 0.0;
  double across_sd = 0.0;
};

/// A road user's motion under an intention, as far as it can be known.
struct Forecast {
  world::Track track;          ///< the median motion
  std::vector<Spread> spread;  ///< one per pose; it never shrinks
};

/// Linear between the poses; before the first as at the first, after the last as at the last.
[[nodiscard]] Spread spread_at(const Forecast& forecast, double time);

/// Deceleration from which on somebody counts as braking [m/s^2]: the project's own mark.
constexpr double braking_mark = 2.0;

/// What an actor does from the scene on if it intends this.
///
/// Vehicles along the lane follow it, others the arc that their velocity and turning rate describe;
/// obstacles, and who is at rest, stay.
/// * Maintaining keeps the speed; the acceleration wavers as an Ornstein-Uhlenbeck process.
/// * Braking, until rest: who brakes already keeps its deceleration; another's grows from what is
///   measured to `braking`.
/// * A lane change leads to the next lane's centre that is still a quarter of a lane away, as a
///   polynomial of fifth order over the way driven, from the lateral speed that there is to none;
///   the less of a lane is left, the less time is. It is made along the way: who stands does not
///   change lanes, and its course turns by 30 deg at most.
/// * Who neither changes lanes nor is near its lane's centre but moves towards it, ends there in
///   the same way: its lane change is nearly over.
/// The spread is that of place and speed as perceived, of the acceleration (maintaining) or the
/// deceleration (braking, to first order), and of the time that a lane change takes (to first
/// order), all taken as independent.
///
/// @param horizon  [s], > 0
/// @throws ContractViolation  if the horizon or a number of the law is out of range
/// @return         poses every 50 ms from scene.time on
[[nodiscard]] Forecast motion_under(const world::Scene& scene, const world::Actor& actor,
                                    Intention intention, double horizon, const MotionLaw& law);

}  // namespace saca::intent
