#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

/// How sure the study's lane tracker must be of both marks, of about 1024. Ours: below, the width
/// that it measures scatters beyond any lane's.
constexpr double least_mark_trust = 300.0;
/// Widths of lanes that are believed [m].
constexpr double narrowest_lane = 2.5;
constexpr double widest_lane = 5.0;

/// The car of an event of the 100-Car study, with what it measured of itself.
///
/// Speed, yaw rate, accelerometer and brake pedal (0 or 1) as recorded: the speed often stands for
/// some tenths of a second, the gyro and the accelerometer have a bias. Where it is nobody knows.
/// The offset is from the lane tracker; a jump by about a lane width, within half a second, from
/// one side to the other is a lane step. No lead is told: which of the radar's targets it is, is
/// found by the conflict that comes (radar_track.h). Rows without speed split the track.
///
/// @param skipped  counts tracks shorter than fewest_packed
/// @return         group: by the car's number, so that no driver is in two; no vehicle where
/// nothing
///                 is left
[[nodiscard]] Recording recording_of_event(const std::vector<HundredCarRow>& rows,
                                           const HundredCarEvent& event, std::string name,
                                           std::map<std::string, std::size_t>& skipped);

}  // namespace saca::recordings
