#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "saca/core/result.h"
#include "saca/eval/forecast_score.h"
#include "saca/sim/scenario.h"

namespace saca::eval {

/// A recorded car whose place the ego may take, so that the others around it are perceived from
/// there.
struct TrafficDrive {
  std::string site;            ///< where it was recorded: "us101", "lankershim"
  std::string group;           ///< learn::group_of: drives of one group share road users
  std::filesystem::path file;  ///< CommonRoad
  std::int64_t obstacle = 0;   ///< the car's id in it
  double from = 0.0;           ///< first instant, in the file's time [s]
  double seconds = 0.0;        ///< for which it was recorded, > 0
};

/// What folders hold.
struct FoundDrives {
  std::vector<TrafficDrive> drives;  ///< ordered by site; within a site shuffled by the seed
  std::vector<std::string> notes;    ///< what was passed over, in sentences
};

/// Every car of the CommonRoad files in the folders or below them, each instant of it once however
/// many files hold it; of each site the first `most` as the seed has shuffled them.
///
/// @param most  of a site, >= 1
/// @param goes_on  asked after each file; false: stop
/// @return  Error::Code::malformed, naming file or folder, where a file cannot be read, two have
///          one name, or there is no car; unreadable where there is no such folder; too_late when
///          stopped
[[nodiscard]] Result<FoundDrives> traffic_drives(const std::vector<std::filesystem::path>& folders,
                                                 std::size_t most, std::uint64_t seed,
                                                 const std::function<bool()>& goes_on);

/// A drive as an encounter in which the ego goes as it was recorded to.
struct PlayedDrive {
  sim::Scenario scenario;
  ForecastWindow window;  ///< in which the scenario's motions and road are those that were recorded
};

/// @return  as sim::import_commonroad; out_of_range also where too little is left to forecast in
[[nodiscard]] Result<PlayedDrive> played_drive(const TrafficDrive& drive);

}  // namespace saca::eval
