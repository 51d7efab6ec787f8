#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/long_work/progress.h"
#include "saca/lab/suites/recorded_drives.h"
#include "saca/lab/suites/shadow_rows.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::suites {

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

/// What SACA watches with; it outlives the watching.
struct WatchTools {
  const manoeuvre::Car* car = nullptr;
  const intent::Model* intent = nullptr;
  const runtime::PlanesSetup* saca = nullptr;
};

/// What was watched.
struct WatchedTraffic {
  std::vector<DriveToWatch> drives;  ///< as many as rows
  std::vector<ShadowRow> rows;       ///< in the order of the drives
  std::size_t found = 0;             ///< drives that there were to draw from
  std::vector<std::string> notes;    ///< on the data: what was passed over
};

/// Reads the folders and watches, with progress on the error stream and a journal that the same
/// watch goes on from.
/// @param made_by  the program and the data that it watches with: the journal of another is refused
/// @return  nullopt: interrupted. Error::Code::malformed, naming file and reason, where a file
///          cannot be read; set-based predictions are passed over
[[nodiscard]] Result<std::optional<WatchedTraffic>> watch_traffic(
    const TrafficWatch& watch, const WatchTools& tools, const std::string& made_by,
    long_work::ProgressDisplay display);

/// The command that watches the same again.
[[nodiscard]] std::string command_of(const TrafficWatch& watch);

/// The sources of the drives, sorted.
[[nodiscard]] std::vector<std::string> sources_of(const WatchedTraffic& traffic);

}  // namespace saca::suites
