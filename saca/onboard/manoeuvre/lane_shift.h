#pragma once

namespace saca::manoeuvre {

/// A point's way across the road at one instant of a `LaneShift`.
struct Lateral {
  double d = 0.0;  ///< lane offset [m]
  double v = 0.0;  ///< its rate [m/s]
  double a = 0.0;  ///< rate of that [m/s^2]
};

/// A way across the road: acceleration to one side, then to the other, with ramps of equal
/// steepness: up, hold, swing to the other side, hold, down. It begins with a rate and ends with
/// none. Near the quickest way for a given acceleration and a steering of limited speed.
struct LaneShift {
  double start_d = 0.0;    ///< [m]
  double start_v = 0.0;    ///< [m/s]
  double amplitude = 0.0;  ///< acceleration during the first hold [m/s^2], signed
  double ramp = 0.1;       ///< from no acceleration to the amplitude [s], > 0
  double first = 0.0;      ///< duration of the first hold [s], >= 0
  double second = 0.0;     ///< of the second [s], >= 0
};

/// @return  seconds until the shift ends
[[nodiscard]] double duration(const LaneShift& shift) noexcept;

/// Before its start a shift goes on with `start_v`; after its end it stands at its last offset.
/// @param time  since its start [s]
[[nodiscard]] Lateral at(const LaneShift& shift, double time) noexcept;

/// The shift from an offset and a rate to rest at another offset.
/// @param amplitude  size of the acceleration to use [m/s^2], > 0; less is used where the way is
/// too
///                   short for the ramps
/// @param ramp       [s], > 0
[[nodiscard]] LaneShift lane_shift(double start_d, double start_v, double end_d, double amplitude,
                                   double ramp) noexcept;

/// The largest rate on the way [m/s], as a size.
[[nodiscard]] double largest_rate(const LaneShift& shift) noexcept;

}  // namespace saca::manoeuvre
