#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/core/result.h"
#include "saca/sim/scenario.h"
#include "saca/traffic/hundred_car_file.h"

namespace saca::sim {

/// What to make of an event of the 100-Car study.
struct HundredCarRequest {
  std::int64_t event = 0;
  double before = 12.0;   ///< seconds kept before the conflict begins, >= 1
  double after = 5.0;     ///< and after the last evasive manoeuvre, >= 0
  std::string narrative;  ///< the study's own words on the event, to be quoted; may be empty
};

/// How much of one vehicle's motion was measured, and what was done to it.
struct TreatedTrack {
  std::int64_t first_row = 0;  ///< within the event, from 1
  std::int64_t last_row = 0;
  std::vector<std::int64_t> ids;  ///< that the radar gave it
  std::size_t num_seen = 0;
  std::size_t num_gaps = 0;
  std::size_t num_filled = 0;       ///< samples on the straight line across gaps
  std::size_t num_outliers = 0;     ///< sightings thrown away
  double rate_disagreement = 0.0;   ///< slope of the ranges against range rate, rms [m/s]
  double largest_correction = 0.0;  ///< by the rule that nobody reverses [m]
};

struct HundredCarReport {
  std::int64_t first_row = 0;  ///< of the scenario, within the event, from 1
  std::int64_t last_row = 0;
  std::size_t num_speed_missing = 0;
  double gyro_bias = 0.0;  ///< taken off the yaw rate [rad/s]
  TreatedTrack lead;
  std::optional<TreatedTrack> follower;
};

struct HundredCarImport {
  Scenario scenario;
  HundredCarReport report;
};

/// Rebuilds a rear-end conflict: the ego from speed and yaw rate, the vehicle ahead from its radar
/// target, the one behind where the rear radar saw it in 20 rows or more.
///
/// @param rows   of the event, all of them
/// @param event  what the videos showed
/// @return       Error::Code::malformed when there is no lead target, or speed is missing for long
///
/// Treatment, all of it told in the scenario's notes: held sensor values are interpolated; range
/// and range rate are fitted together by a parabola over +-0.5 s; gaps up to 1.5 s are bridged;
/// nobody reverses. The driver is taken to keep the middle of the lane until the conflict begins;
/// that fixes the gyro's bias (straight road) or the curvature. Sizes, masses, lane width, the
/// ego's lane and the grip are assumptions.
[[nodiscard]] Result<HundredCarImport> rebuild_hundred_car(
    const std::vector<traffic::HundredCarRow>& rows, const traffic::HundredCarEvent& event,
    const HundredCarRequest& request);

/// Finds and reads the event's rows and its line in the event table, and rebuilds it.
/// @param path  the release's folder (or one with `timeseries/` and `meta/`), or a time-series
/// file;
///              then the table is sought beside it and one folder up
[[nodiscard]] Result<HundredCarImport> import_hundred_car(const std::filesystem::path& path,
                                                          const HundredCarRequest& request);

}  // namespace saca::sim
