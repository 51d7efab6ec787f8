#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::eval {

/// A recorded car whose place the ego may take, so that the others around it are perceived from
/// there.
struct TrafficDrive {
  std::string site;   ///< where it was recorded: "us101", "lankershim"
  std::string group;  ///< intention_scoring::group_of: drives of one group share road users
  std::filesystem::path file;  ///< CommonRoad
  std::int64_t obstacle = 0;   ///< the car's id in it
  double from = 0.0;           ///< first instant, in the file's time [s]
  double seconds = 0.0;        ///< for which it was recorded, > 0
};

/// What files hold.
struct FoundDrives {
  std::vector<TrafficDrive> drives;
  std::map<std::string, std::size_t> skipped;  ///< what was passed over, by its reason
  std::size_t num_others = 0;                  ///< tracks of other than cars, which are no egos
};

/// Every car of CommonRoad files, each instant of it once however many files hold it, in the order
/// of the files.
///
/// @param goes_on  asked after each file; false: stop
/// @return  Error::Code::malformed, naming the file, where one cannot be read or two have one name;
///          too_late when stopped
[[nodiscard]] Result<FoundDrives> drives_in(const std::vector<std::filesystem::path>& files,
                                            const std::function<bool()>& goes_on);

/// The first `most` in an order that the seed and a name give, the same everywhere.
template <class Drive>
[[nodiscard]] std::vector<Drive> some_of(std::vector<Drive> drives, std::size_t most,
                                         std::uint64_t seed, std::string_view name) {
  Fnv salt;
  salt.add(name);
  std::mt19937_64 rng = scenario::generator(seed, salt.value());
  for (std::size_t k = drives.size(); k > 1; --k) {  // std::shuffle's is not the same everywhere
    std::swap(drives[k - 1], drives[rng() % k]);
  }
  if (drives.size() > most) {
    drives.erase(drives.begin() + static_cast<std::ptrdiff_t>(most), drives.end());
  }
  return drives;
}

/// The drives in the CommonRoad files in the folders or below them, ordered by site; of each site
/// the first `most` as the seed has shuffled them.
///
/// @param most  of a site, >= 1
/// @return  as `drives_in`; malformed, naming the folder, also where there is no car; unreadable
///          where there is no such folder
[[nodiscard]] Result<FoundDrives> traffic_drives(const std::vector<std::filesystem::path>& folders,
                                                 std::size_t most, std::uint64_t seed,
                                                 const std::function<bool()>& goes_on);

/// A drive as an encounter in which the ego goes as it was recorded to.
struct PlayedDrive {
  scenario::Scenario scenario;
  ForecastWindow window;  ///< in which the scenario's motions and road are those that were recorded
};

/// @return  as importers::import_commonroad; out_of_range also where too little is left to forecast
/// in
[[nodiscard]] Result<PlayedDrive> played_drive(const TrafficDrive& drive);

}  // namespace saca::eval
