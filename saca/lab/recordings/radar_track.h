#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "saca/lab/recordings/hundred_car_file.h"

namespace saca::recordings {

enum class Radar : std::uint8_t { front, rear };

/// What a row knows of a thing that is followed.
enum class Sighting : std::uint8_t { kept, none, outlier };

/// One thing followed through the rows, whatever columns and ids it had. One entry a row from
/// `first_row` to `last_row`; where it was not seen, numbers are on the straight line between their
/// neighbours.
struct RadarTrack {
  std::size_t first_row = 0;  ///< index into the rows
  std::size_t last_row = 0;
  std::vector<double> range;    ///< [m]
  std::vector<double> rate;     ///< [m/s]
  std::vector<double> azimuth;  ///< > 0 to the car's left [rad]
  std::vector<Sighting> sightings;
  std::vector<std::int64_t> ids;  ///< that the radar gave it; 0 where it was not seen
};

/// How far the slope of the ranges and the measured range rate differ, rms over entries [first,
/// last], both fitted by lines over +-0.5 s [m/s].
[[nodiscard]] double rate_disagreement(const RadarTrack& track, std::size_t first,
                                       std::size_t last);

// How a thing is followed. Ours, chosen by eye on the study's events.
constexpr double longest_gap = 1.5;     ///< [s] bridged; longer ends the track
constexpr double near_axis = 1.5;       ///< a target this far aside is in the car's lane [m]
constexpr double smallest_range = 1.5;  ///< nearer, the radar's range wanders: no seed there [m]
constexpr double outlier_bound = 1.0;   ///< from what the three rows on either side predict [m]

/// The vehicle ahead in the conflict: within [first, last], of the nearest target near the axis in
/// each row, the one with the smallest range / closing speed, among those closing at 1 m/s or more.
/// @return  nullopt when there is none
[[nodiscard]] std::optional<RadarTrack> lead_track(const std::vector<HundredCarRow>& rows,
                                                   std::size_t first, std::size_t last);

/// The vehicle behind: of all that were the nearest target near the axis in some row of [first,
/// last], the one seen closest in time to the conflict, and of several such the nearest.
/// @param conflict  row at which the conflict begins
/// @param fewest    rows in which it must have been seen
[[nodiscard]] std::optional<RadarTrack> follower_track(const std::vector<HundredCarRow>& rows,
                                                       std::size_t first, std::size_t last,
                                                       std::size_t conflict, std::size_t fewest);

}  // namespace saca::recordings
