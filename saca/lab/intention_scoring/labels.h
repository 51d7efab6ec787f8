#pragma once

#include <cstdint>
#include <vector>

namespace saca::intention_scoring {

/// What a vehicle truly did, at steps of `frame_step`: smoothed with hindsight, or simulated.
struct TrueMotion {
  std::vector<double> acceleration;  ///< along its motion [m/s^2]
  std::vector<double> lateral;  ///< to the left of a lane's centre, on into the next lanes [m];
                                ///< NaN: on no lane
  std::vector<double> lateral_speed;  ///< its rate [m/s]; NaN likewise
  double lane_width = 3.5;            ///< [m], > 0
};

/// When an act counts, and from when to when.
struct LabelRule {
  // A lateral move: all the while the lateral speed keeps its side and stays above `aside_end`.
  double aside_begin = 0.35;  ///< the label begins with this lateral speed [m/s]; before, in doubt
  double aside_end = 0.20;    ///< and ends with this one
  double least_way = 1.0;     ///< of a move [m]
  double swerve = 0.7;        ///< a move within the lane counts if it gets this fast [m/s]
  double doubtful_way = 0.6;  ///< a shorter one is none; between, nobody can say
  double undone_within =
      1.5;  ///< [s] after its end: who has come back half of the way did not move
  // A braking: all the while the acceleration is below `braking_end`.
  double braking = -2.0;           ///< the label begins with this [m/s^2]; before, in doubt
  double least_braking = 0.3;      ///< for so long [s]
  double braking_end = -1.0;       ///< and ends with this [m/s^2]
  double least_loss = 1.5;         ///< of speed [m/s]
  double doubtful_braking = -1.6;  ///< one that reaches only this is doubtful [m/s^2]
  double around_change = 0.2;      ///< [s] to both sides of a change of label nobody can say
};

struct Labels {
  std::vector<std::uint8_t> classes;  ///< as intent::Intention
  std::vector<bool> scored;           ///< false: in doubt
  std::vector<double> braking_times;  ///< the acceleration of a braking falls below `braking` [s]
};

/// The class of each frame. Looks ahead and back over the whole motion; what is told to a model
/// never does.
///
/// A lane change (LC, RC) begins with the first lasting lateral motion and ends with it, beyond the
/// line; it leads into another lane, or is a swerve within its own; wandering within the lane is in
/// doubt; braking (FB) is a deceleration beyond 2 m/s^2 and its end; both at once are LB, RB; all
/// else is M. Acts that the ends of the motion cut off before they can be told are in doubt.
/// @throws ContractViolation  if the three differ in length
[[nodiscard]] Labels labels_of(const TrueMotion& motion, const LabelRule& rule = {});

}  // namespace saca::intention_scoring
