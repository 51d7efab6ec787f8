#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::importers {

/// What to make of an event of the 100-Car study.
struct HundredCarRequest {
  std::int64_t event = 0;
  double before = 12.0;   ///< seconds kept before the conflict begins, 1 to 600
  double after = 5.0;     ///< and after the last evasive manoeuvre, 0 to 600
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
  std::int64_t conflict_row = 0;  ///< in which the conflict begins, likewise
  std::size_t num_speed_missing = 0;
  double gyro_bias = 0.0;    ///< taken off the yaw rate [rad/s]
  double curvature = 0.0;    ///< of the lane, > 0 turns left [1/m]
  double kept_for = 0.0;     ///< how long before the conflict the lane is taken to be kept [s]
  double keeping_rms = 0.0;  ///< of the offset from its middle meanwhile [m]
  TreatedTrack lead;
  std::optional<TreatedTrack> follower;
};

struct HundredCarImport {
  scenario::Scenario scenario;
  HundredCarReport report;
};

/// Why an event is not rebuilt.
enum class HundredCarReason : std::uint8_t {
  unreadable,               ///< its rows or its line in the table of events
  other_conflict,           ///< no rear-end conflict: the other is neither ahead nor behind
  leaves_lane,              ///< the driver changed lanes, turned or parked when it began, says the
                            ///< study
  no_lead,                  ///< no radar target ahead for long enough
  no_follower,              ///< struck from behind, and none was seen there for long enough
  sensor_gap,               ///< no speed or yaw rate for long
  impossible_values,        ///< a speed, yaw rate or range that no car has
  no_lane_before,           ///< the motion before the conflict fits no lane
  leaves_road,              ///< as rebuilt the driver leaves the road
  touches_in_near_crash,    ///< as rebuilt the driver touches somebody; the study: a near-crash
  touches_nobody_in_crash,  ///< as rebuilt the driver touches nobody; the study: a crash
  no_scenario,              ///< what comes of it is none that a file may hold
};

/// "leaves_road".
[[nodiscard]] std::string_view name(HundredCarReason reason);
/// In words, for people: "as rebuilt the driver leaves the road".
[[nodiscard]] std::string_view meaning(HundredCarReason reason);

struct HundredCarRefusal {
  HundredCarReason reason = HundredCarReason::unreadable;
  std::string message;  ///< names the event, what was wanted and what came
};

/// Rebuilds a rear-end conflict: the ego from speed and yaw rate, the vehicle ahead from its radar
/// target, the one behind where the rear radar saw it in 20 rows or more.
///
/// @param rows   of the event, all of them
/// @param event  what the videos showed
/// @return       a scenario that `read_scenario` takes, or why there is none; whatever the rows
///               and the event hold, nothing is thrown
///
/// Treatment, all of it told in the scenario's notes: held sensor values are interpolated; range
/// and range rate are fitted together by a parabola over +-0.5 s; gaps up to 1.5 s are bridged;
/// nobody reverses. The driver is taken to keep a lane of one curvature in the 12 s before the
/// conflict begins (2 s at least), or in the last 8 or 5 s of them when the motion fits no lane
/// before, and the scenario then begins there: that fixes where the lane lies, its curvature and
/// the gyro's bias (ego_path.h), and nothing of what the driver does later is used. Where he leaves
/// the road when the last evasive manoeuvre is over, as who turns off does, the scenario ends
/// there. Sizes, masses, lane width and the grip are assumptions; so is the ego's lane, the
/// right-most, or the one beside it where the study says that the driver steered to the right and
/// the right-most would not hold him.
///
/// What is rebuilt is held to what the study says: while everybody concerned was recorded, the
/// driver stays on the road, touches nobody in a near-crash, and touches somebody in a crash. What
/// does not is refused: then either the rebuilt motion or what was assumed of the road is wrong.
[[nodiscard]] std::variant<HundredCarImport, HundredCarRefusal> judged_hundred_car(
    const std::vector<recordings::HundredCarRow>& rows, const recordings::HundredCarEvent& event,
    const HundredCarRequest& request);

/// The same with the refusal as an error, Error::Code::malformed.
[[nodiscard]] Result<HundredCarImport> rebuild_hundred_car(
    const std::vector<recordings::HundredCarRow>& rows, const recordings::HundredCarEvent& event,
    const HundredCarRequest& request);

/// Finds and reads the event's rows and its line in the event table, and rebuilds it.
/// @param path  the release's folder (or one with `timeseries/` and `meta/`), or a file of series:
///              then the table is sought beside it and one folder up
[[nodiscard]] Result<HundredCarImport> import_hundred_car(const std::filesystem::path& path,
                                                          const HundredCarRequest& request);

}  // namespace saca::importers
