#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/pose.h"

namespace saca::recordings {

// Recordings of all sources in one shape: what a model of intentions is trained on.

/// A number that was not recorded.
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// One instant of a recorded vehicle, as recorded: noisy. NaN: not known.
struct Sample {
  Pose X_WA{{not_known, not_known}, not_known};  ///< the body's centre; known wholly or not at all
  double speed = 0.0;                            ///< along the heading [m/s]; always known

  // In the lane that it is tracked in (lane_map.h), in that lane's direction.
  double offset = not_known;      ///< of the body's centre from the lane's, > 0 to the left [m]
  double heading = not_known;     ///< of the body against the lane [rad]
  double lane_width = not_known;  ///< [m], > 0
  double curvature = not_known;   ///< of the lane's centre line, > 0 to the left [1/m]
  int lane_step = 0;       ///< lanes crossed since the sample before: +1 into the next to the left
  bool left_lane = false;  ///< there is a neighbouring lane of the same direction
  bool right_lane = false;

  /// To the vehicle ahead in the lane, bumper to bumper [m]; +inf: nobody within lead_reach.
  double gap = not_known;
  double lead_speed = not_known;  ///< [m/s]; NaN without a lead

  // Shared by the vehicle or measured in it.
  double brake_pedal = not_known;            ///< 0 to 1
  double steering = not_known;               ///< of the wheels [rad], > 0 to the left
  double throttle = not_known;               ///< 0 to 1
  double measured_acceleration = not_known;  ///< by an accelerometer, along the vehicle [m/s^2]
  double measured_yaw_rate = not_known;      ///< [rad/s]
};

/// How far ahead a lead is looked for [m].
constexpr double lead_reach = 100.0;

/// One vehicle's samples at equal steps. Where the recording has a gap, another one of the same id
/// follows.
struct RecordedVehicle {
  std::int64_t id = 0;          ///< in its recording
  std::string type;             ///< the source's word; may be empty
  double length = not_known;    ///< [m], > 0
  double width = not_known;     ///< [m], > 0
  double start = 0.0;           ///< of the first sample in the recording's time [s]
  std::vector<Sample> samples;  ///< at least one
};

/// What was recorded at one place in one go, or one cut of it.
struct Recording {
  std::string name;   ///< the file's
  std::string site;   ///< us101, lankershim, peachtree, i80, 100car, ...
  std::string group;  ///< two recordings of different groups share no vehicle: split by this
  double step = 0.1;  ///< between samples [s], > 0
  std::vector<RecordedVehicle> vehicles;  ///< at least one
};

/// Recordings, and how many of what was left out, by reason.
struct RecordedSet {
  std::vector<Recording> recordings;
  std::map<std::string, std::size_t> skipped;
};

/// The first rule that a set breaks: "recording a.xml: vehicle 7: sample 3: speed: want a finite
/// number". nullopt: none.
///
/// Rules: at least one recording, one vehicle in each, one sample in each of those; names, sites
/// and groups are neither empty nor of several lines, reasons likewise; numbers are finite or,
/// where a comment above allows it, NaN; `gap` may be +inf; a lead's speed only beside a finite
/// gap; a lane step only with an offset; pedals in [0, 1]; sizes > 0.
[[nodiscard]] std::optional<std::string> broken_rule(const RecordedSet& set);

/// A set in figures.
struct SetCounts {
  std::size_t recordings = 0;
  std::size_t groups = 0;
  std::size_t vehicles = 0;
  std::size_t samples = 0;
  double hours = 0.0;          ///< samples by steps, of all vehicles together
  std::size_t steps_left = 0;  ///< lanes crossed to the left
  std::size_t steps_right = 0;
  std::size_t in_lane = 0;    ///< samples with an offset
  std::size_t with_lead = 0;  ///< samples with a finite gap
};

/// Of all recordings, and by site.
[[nodiscard]] SetCounts counts_of(const RecordedSet& set);
[[nodiscard]] std::map<std::string, SetCounts> counts_by_site(const RecordedSet& set);

}  // namespace saca::recordings
