#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/planes_making.h"
#include "saca/lab/eval/shadow_rows.h"

namespace saca::app {

/// Which recorded drives are watched.
struct TrafficWatch {
  std::vector<std::string> folders;  ///< with CommonRoad files or the 100-Car study's release
  int count = 1'000;                 ///< of each source, drawn by `seed`
  std::uint64_t seed = 1;
  std::string car = "compact_rwd_ev";
  reflex::Thresholds thresholds;
  std::string output;  ///< page and figures; the journal lies beside
  int threads = 1;
};

/// A recorded drive as a scenario, and what of it counts.
struct RecordedEgo {
  scenario::Scenario scenario;
  eval::ShadowWindow window;
};

/// One that may be watched.
struct DriveToWatch {
  std::string source;   ///< "us101", "lankershim", "100car"
  std::string name;     ///< within it
  std::string command;  ///< that makes the scenario
  std::function<Result<RecordedEgo>()> open;
};

/// What was watched.
struct WatchedTraffic {
  std::shared_ptr<const PlanesOfCar> planes;
  std::vector<DriveToWatch> drives;   ///< as many as rows
  std::vector<eval::ShadowRow> rows;  ///< in the order of the drives
  std::size_t found = 0;              ///< drives that there were to draw from
  std::vector<std::string> notes;     ///< on the data: what was passed over
};

/// Reads the folders and watches, with progress on the error stream and a journal that the same
/// command goes on from.
/// @return  nullopt: interrupted. Error::Code::malformed, naming file and reason, where a file
///          cannot be read; set-based predictions are passed over
[[nodiscard]] Result<std::optional<WatchedTraffic>> watch_traffic(const TrafficWatch& options);

}  // namespace saca::app
