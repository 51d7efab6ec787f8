#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/onboard/manoeuvre/car.h"

namespace saca::verification {

/// A measured quantity of the car beside what an independent prototype found.
struct Figure {
  std::string name;  ///< e.g. "physics.aeb.stop_distance_m.v14.mu0.9"; the unit is in the name
  double value = 0.0;
  std::optional<double> reference;  ///< nullopt where there is only a limit
  double low = 0.0;                 ///< band that the value should lie in
  double high = 0.0;
};

[[nodiscard]] bool in_band(const Figure& figure);

/// One full stop straight ahead.
struct Stop {
  double distance = 0.0;           ///< of the centre of mass [m]
  double time = 0.0;               ///< [s]
  double peak_deceleration = 0.0;  ///< [m/s^2], >= 0
};

enum class Abs { ideal, deployed };

/// @param speed  [m/s], > 0
/// @param grip   friction coefficient [-], in [0.2, 1.0]; known exactly
[[nodiscard]] Stop stop_straight(const manoeuvre::Car& car, Abs abs, double speed, double grip);

/// A lane change of 3.5 m without braking: policy 1.
struct LaneChange {
  double settled = 0.0;       ///< from when on it stays within 0.2 m and 2 degrees of its end [s]
  double to_2_1_m = 0.0;      ///< until 2.1 m to the side, enough to pass a car's width [s]
  double way_to_2_1_m = 0.0;  ///< forward travel of the centre of mass until then [m]
};
[[nodiscard]] LaneChange change_lane(const manoeuvre::Car& car, double speed, double grip);

/// Speed above which a lane change passes an obstacle 2.1 m wide that braking would hit: the way
/// forward until 2.1 m to the side is then shorter than a stop. Dry road, grip 0.9 [m/s].
[[nodiscard]] double swerve_beats_braking(const manoeuvre::Car& car);

/// A T-drift to the left on a straight road, to rest: policy 5.
struct DriftStop {
  double time = 0.0;      ///< [s]
  double forward = 0.0;   ///< travel of the centre of mass along the lane [m]
  double sideways = 0.0;  ///< likewise to the left [m]
  double heading = 0.0;   ///< at the end, against the lane [rad]
};
/// @param speed  [m/s], inside the car's DriftDomain
/// @param grip   friction coefficient [-], in [0.2, 1.0]; known exactly
[[nodiscard]] DriftStop drift_to_rest(const manoeuvre::Car& car, double speed, double grip);

/// How far steps of 1 ms end from steps of 0.25 ms after 2 s of a lane change at 14 m/s.
struct IntegrationError {
  double position = 0.0;  ///< [m]
  double heading = 0.0;   ///< [rad]
};
[[nodiscard]] IntegrationError integration_error(const manoeuvre::Car& car);

/// Order of convergence of `vehicle::step` over 0.8 s of a smooth open-loop turn: steps of 1 and of
/// 0.5 ms against 0.0625 ms [-].
[[nodiscard]] double integration_order(const manoeuvre::Car& car);

/// The rows of the vehicle's table: stops with both anti-lock brakes, peak decelerations, lane
/// changes, drifts, integration. Takes a few seconds of simulated driving per row, milliseconds of
/// real time.
[[nodiscard]] std::vector<Figure> physics_figures(const manoeuvre::Car& car);

}  // namespace saca::verification
