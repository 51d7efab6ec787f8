#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/recordings/commonroad.h"
#include "saca/lab/recordings/lane_fit.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::importers {

/// What to make of recorded traffic.
struct TrafficRequest {
  /// The obstacle whose place the ego takes, as recorded; without it the ego begins at the first
  /// planning problem's start and goes on along its lane at constant speed.
  std::optional<std::int64_t> ego;
  std::optional<double> from;  ///< the scenario's 0 in the file's time [s]; else the ego's start
  /// How long the scenario goes on after the last sample, everybody straight on [s], >= 0.
  double after = 0.0;
};

/// A recorded body in the scenario.
struct TrafficActor {
  std::string name;       ///< in the scenario
  std::int64_t obstacle;  ///< id in the file
};

/// What was made of it.
struct TrafficReport {
  double from = 0.0;          ///< the scenario's 0 in the file's time [s]
  Vec2 origin_W;              ///< the scenario's origin in the file's coordinates [m]
  recordings::LaneFit lane;   ///< in the file's coordinates
  double widened_left = 0.0;  ///< how far the left edge was moved out to hold recorded bodies [m]
  double widened_right = 0.0;
  std::vector<TrafficActor> actors;             ///< the nearest first
  std::map<std::string, std::size_t> left_out;  ///< how many obstacles, by reason
  std::map<std::string, std::size_t> ignored;   ///< how many elements of the file, by name
  std::size_t num_filled = 0;                   ///< of the samples kept
  std::size_t num_outliers = 0;
  double rms_shift = 0.0;  ///< of positions by smoothing, over all samples kept [m]
  double largest_shift = 0.0;
  double hardest = 0.0;  ///< largest acceleration that is left [m/s^2]
};

struct TrafficImport {
  scenario::Scenario scenario;
  TrafficReport report;
};

/// Hardest acceleration in any direction that a smoothed track may have: more is an error of the
/// recording. Source: 1.2 g, above what tyres on dry asphalt do (Wong, Theory of Ground Vehicles).
constexpr double hardest_possible = 12.0;  // [m/s^2]

/// Recorded traffic as a scenario: one vehicle's place is the ego's, the others do what was
/// recorded.
///
/// @return  Error::Code::out_of_range when there is no such ego, it has no lane (lane_fit.h), is
///          recorded for less than 1 s from `from` on, or touches somebody at the start
///
/// Treatment, all of it told in the scenario's notes: tracks are smoothed (smooth_track.h) and kept
/// from their first to their last sample; of a track with a gap of more than 1.5 s the longest part
/// is kept. Left out and counted is who is gone before the start, seen for less than 0.5 s, of no
/// size that a scenario may have, moving faster than a scenario may or harder than
/// hardest_possible, touching a nearer one at the start, appearing inside the ego on its expected
/// way, or farther than the world::max_actors nearest; near is the least distance from the ego on
/// that way. The road's edges are moved out to 0.2 m beyond every vehicle that was recorded with
/// its centre between them. Kinds, masses, grip and what stands beyond the road's edges are
/// assumptions.
[[nodiscard]] Result<TrafficImport> traffic_scenario(const recordings::CommonRoad& file,
                                                     const TrafficRequest& request);

/// Reads a file and makes a scenario of it.
[[nodiscard]] Result<TrafficImport> import_commonroad(const std::filesystem::path& path,
                                                      const TrafficRequest& request);

}  // namespace saca::importers
