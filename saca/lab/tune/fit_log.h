#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::tune {

/// What a test may measure, in the order of `signals`.
enum class Signal : std::uint8_t {
  speed,
  a_x,
  a_y,
  yaw_rate,
  sideslip,
  wheel_front_left,
  wheel_front_right,
  wheel_rear_left,
  wheel_rear_right
};
constexpr std::size_t num_signals = 9;

/// How a signal stands in a log, and what is known of its sensor.
struct SignalInfo {
  std::string_view column;  ///< its name, with unit
  double unit;              ///< the column's unit in SI units
  double largest;           ///< size that no car reaches, in the column's unit
  double offset_sd;         ///< sd of the sensor's constant error, in the column's unit; 0: none
  double typical_noise;     ///< sd of a usual sensor's noise, in the column's unit
};

/// Offsets: of inertial sensors for cars, with their mounting; noise: of the same after the usual
/// filters. Assumptions; the noise in a log is measured, not taken from here.
[[nodiscard]] const SignalInfo& info(Signal signal);

/// What the model says of a signal, in SI units.
[[nodiscard]] double value_of(Signal signal, const vehicle::VehicleState& state);

/// The two tests that are known.
enum class TestKind : std::uint8_t {
  brake,  ///< straight, from speed to rest or part of it
  steer   ///< ISO 7401: constant speed, one step of the steering angle
};
constexpr std::array<std::string_view, 2> kind_names{"brake test", "step steer"};

/// One measured signal.
struct Series {
  Signal signal = Signal::speed;
  std::vector<double> values;  ///< SI   (rows)
};

/// One test as it was driven: what was commanded and what was measured.
struct Log {
  std::string name;  ///< for messages, usually the path
  TestKind kind = TestKind::brake;
  std::vector<double> time;               ///< [s], increasing   (rows)
  std::vector<vehicle::Command> command;  ///< each held until the next row   (rows)
  bool motor_known = false;               ///< else the motor holds the speed before the braking
  std::vector<Series> measured;           ///< the speed first, none twice
  std::size_t event = 0;                  ///< the row where braking or steering begins, > 0
};

/// Reads a test from a CSV file as docs/formats.md describes it, and finds out from the commands
/// which test it is.
///
/// @param source  name for messages, usually the path
/// @param car     what can be measured with scales and tape must be right: the log is checked
///                against it
/// @return        a log fit for `fit_vehicle`; rows after a brake test's car has come to less than
///                1 m/s are left out. Else Error::Code::malformed, naming source, line or column,
///                wanted and got: what `read_csv` refuses, a missing column, a time that does not
///                increase or is too coarse, no braking and no step or both, nothing quiet before
///                it, too little after it, signals that contradict one another or the commands
///                (as with a wrong unit or sign)
[[nodiscard]] Result<Log> read_log(std::string_view text, std::string_view source,
                                   const vehicle::Vehicle& car);

/// The log as a CSV file that `read_log` reads.
[[nodiscard]] std::string write_log(const Log& log);

}  // namespace saca::tune
