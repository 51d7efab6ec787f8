#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/core/static_vector.h"

namespace saca::recordings {

// The files of the 100-Car Naturalistic Driving Study (Virginia Tech Transportation Institute), as
// released. Source of columns, units and signs: Researcher Dictionary for Time-Series Data, version
// 1.2, 2010, and Researcher Dictionary for Video Reduction Data, version 1.3.

/// One thing that a radar saw, in SI units and our signs. What it tells of beyond 500 m or 100 m/s
/// is left out (bounds are ours).
struct RadarTarget {
  std::int64_t id = 0;   ///< 1 to 255, given anew in turn
  double range = 0.0;    ///< [m], > 0
  double rate = 0.0;     ///< of the range [m/s], < 0 while closing
  double azimuth = 0.0;  ///< from the radar's axis, > 0 to the car's left, front and rear [rad]
};

constexpr std::size_t radar_columns = 7;

/// A tenth of a second. What is missing is NaN.
struct HundredCarRow {
  std::int64_t sync = 0;  ///< the study's row counter; grows by one
  double speed = 0.0;     ///< [m/s]
  double yaw_rate = 0.0;  ///< [rad/s], > 0 to the left
  bool brake = false;
  bool brake_known = true;    ///< false: nothing was recorded of the pedal
  double acceleration = 0.0;  ///< by the accelerometer, forward [m/s^2]
  double left_mark = 0.0;     ///< of the lane, from the car's centre line, > 0 to the left [m]
  double right_mark = 0.0;    ///< likewise: < 0 in the usual case
  double mark_trust = 0.0;    ///< the tracker's word on the worse of both, up to about 1024
  StaticVector<RadarTarget, radar_columns> front;
  StaticVector<RadarTarget, radar_columns> rear;
};

/// Time between rows [s].
constexpr double hundred_car_step = 0.1;

/// The rows of one event.
/// @param text    a time-series file: one event's, or a compiled one of many
/// @param source  name for messages
/// @return        Error::Code::malformed, naming source, line, wanted and got, when the event's
/// rows
///                have not 79 columns, hold text or skip a tenth; when there are none of the event
[[nodiscard]] Result<std::vector<HundredCarRow>> read_hundred_car_rows(std::string_view text,
                                                                       std::string_view source,
                                                                       std::int64_t event);

/// The name of the release's table of events.
constexpr std::string_view hundred_car_table = "100CarEventVideoReducedData_v1_5.txt";

/// Whether a file of the release with this name holds series: HundredCar_*.
[[nodiscard]] bool is_hundred_car_series(std::string_view file_name);

/// Takes the first rows on end that have the same first field off a file's text.
[[nodiscard]] std::string_view cut_hundred_car_event(std::string_view& rest);

/// The event of which a row is, its first field; nullopt when that is no whole number from 0 to
/// 1e9.
[[nodiscard]] std::optional<std::int64_t> hundred_car_number(std::string_view row);

/// What people saw in the videos of one event; words are the study's.
struct HundredCarEvent {
  std::int64_t vehicle = 0;  ///< the study's number of the car; events of one may be one driver's
  std::int64_t start_sync = 0;  ///< the conflict begins
  std::int64_t end_sync = 0;    ///< the last evasive manoeuvre is over
  std::string severity;
  std::string nature;
  std::string manoeuvre_before;
  std::string precipitating;
  std::string reaction;
  std::string control_after;
  std::string behaviour;
  std::string surface;
  std::string flow;
  std::string lanes;
  std::string alignment;
  std::string locality;
  std::string light;
  std::string weather;
  std::string lead_type;
  std::string third_place;  ///< where the third vehicle was
  std::string third_type;
};

/// @param text  the event table, tab-separated (100CarEventVideoReducedData_v1_5.txt)
[[nodiscard]] Result<HundredCarEvent> read_hundred_car_event(std::string_view text,
                                                             std::string_view source,
                                                             std::int64_t event);

}  // namespace saca::recordings
