#pragma once

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intent {

/// An acceleration that wavers about 0: an Ornstein-Uhlenbeck process.
struct OrnsteinUhlenbeck {
  double sd = 0.0;    ///< [m/s^2], >= 0
  double time = 1.0;  ///< it is correlated as exp(-t / this) [s], > 0
};

/// How people really drive under an intention, and how far they differ in it.
///
/// What vehicles do was measured by `saca intent motion` in recordings of NGSIM and of the 100-Car
/// study (docs/intention.md, docs/results.md); the numbers of pedestrians and cyclists are
/// assumptions.
struct MotionLaw {
  OrnsteinUhlenbeck driving{0.86, 3.8};  ///< of a vehicle that maintains
  OrnsteinUhlenbeck walking{0.3, 1.0};   ///< of pedestrians and cyclists, in each direction
  double braking = 2.6;                  ///< of one who does not brake yet: median [m/s^2], > 0
  double braking_log_sd = 0.32;          ///< standard deviation of its logarithm [-]
  double braking_rise = 2.0;             ///< until such a braking has built up, linearly [s], >= 0
  bool holds = true;          ///< who brakes already goes on as it does; else it brakes harder, to
                              ///< `braking` at least
  double held_log_sd = 0.61;  ///< of one who brakes: of the logarithm of what it goes on with over
                              ///< what is measured now [-]
  double lane_change = 5.9;   ///< from lane to lane: median [s], > 0
  double lane_change_log_sd = 0.44;  ///< standard deviation of its logarithm [-]
  double walking_speed = 1.4;        ///< of a pedestrian who starts to cross [m/s], > 0: 5 km/h, as
                                     ///< the adult of Euro NCAP's CPNA walks
  double walking_stop = 2.0;  ///< deceleration of a pedestrian who stops: about a step [m/s^2], > 0
  double cycling_stop = 2.75;  ///< of a cyclist; firm for a bicycle [m/s^2], > 0
  double starting = 1.5;       ///< acceleration to `walking_speed` [m/s^2], > 0
  double turning = 2.0;        ///< of pedestrians and cyclists to the lane: sideways [m/s^2], > 0
};

/// A road user's motion under an intention, as far as it can be known.
struct Forecast {
  world::Track track;            ///< the median motion
  world::SpreadOverTime spread;  ///< along its line and across; one per pose
};

/// Between the poses of a forecast [s].
constexpr double motion_step = 0.05;

/// Standard deviation of the way made in `time`: sd t^2 / 2 at first [m].
[[nodiscard]] double ornstein_uhlenbeck_sd(const OrnsteinUhlenbeck& process, double time);

/// Deceleration from which on somebody counts as braking [m/s^2]: the project's own mark.
constexpr double braking_mark = 2.0;

/// What an actor does from the scene on if it intends this.
///
/// Vehicles and cyclists along the lane follow it, others the arc that their velocity and turning
/// rate describe, pedestrians a straight line; obstacles, and who is at rest, stay.
/// * Maintaining keeps the speed; the acceleration wavers.
/// * Braking, until rest: who brakes already keeps its deceleration where the law holds it;
/// another's
///   grows from what is measured to `braking`.
/// * A lane change leads to the next lane's centre that is still a quarter of a lane away, as a
///   polynomial of fifth order over the way driven, from the lateral speed that there is to none;
///   the less of a lane is left, the less time is. It is made along the way: who stands does not
///   change lanes, and its course turns by 30 deg at most.
/// * Who neither changes lanes nor is near its lane's centre but moves towards it, ends there in
///   the same way: its lane change is nearly over.
/// * Pedestrians and cyclists stop with `walking_stop` or `cycling_stop`, or what is measured if it
///   is more; for crossing see `crossing_motion`.
/// The spread is that of place and speed as perceived, of the acceleration (maintaining) or the
/// deceleration (braking, to first order), and of the time that a lane change takes (to first
/// order), all taken as independent. The acceleration of pedestrians and cyclists wavers across
/// their line as well.
///
/// @param horizon  [s], > 0
/// @throws ContractViolation  if the horizon or a number of the law is out of range, or somebody of
///                            its kind cannot intend this
/// @return         poses every 50 ms from scene.time on
[[nodiscard]] Forecast motion_under(const world::Scene& scene, const world::Actor& actor,
                                    Intention intention, double horizon, const MotionLaw& law);

}  // namespace saca::intent
