#pragma once

#include <cmath>
#include <limits>

namespace saca::intent {

/// Of a quantity that is not known.
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What can be seen of one road user from outside at one instant, as a tracker knows it: noisy.
/// A quantity that is NaN is not known.
struct Observation {
  double speed = 0.0;         ///< over ground [m/s], >= 0
  double acceleration = 0.0;  ///< along its motion [m/s^2]
  double yaw_rate = 0.0;      ///< [rad/s]
  double offset = not_known;  ///< of its centre to the left of the nearest lane centre, along
                              ///< its own direction [m]; NaN: on no lane
  double lateral_speed = not_known;  ///< to the left across the lane [m/s]
  double heading = not_known;        ///< of its body against the lane [rad]
  double lane_width = not_known;     ///< [m]
  double gap = not_known;            ///< to the one ahead in its lane, bumper to bumper [m];
                                     ///< infinite: nobody is ahead
  double gap_speed = not_known;      ///< speed of the one ahead less its own [m/s]
  // Shared by the vehicle itself; most do not.
  double steering = not_known;  ///< angle of the road wheels [rad]
  double throttle = not_known;  ///< pedal, 0 to 1
  double brake = not_known;     ///< likewise; brake lights: 0 or 1
};

/// Way to the left from one observation to the next [m]; NaN unless both are in a lane. An offset
/// that jumps by more than half a lane's width is another lane, not another place.
[[nodiscard]] inline double moved_aside(const Observation& last, const Observation& now) {
  const double moved = now.offset - last.offset;
  return std::abs(moved) > 0.5 * now.lane_width ? moved - std::copysign(now.lane_width, moved)
                                                : moved;
}

}  // namespace saca::intent
