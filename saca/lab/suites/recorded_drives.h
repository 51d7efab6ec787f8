#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/lab/suites/shadow.h"

namespace saca::suites {

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

/// What folders hold.
struct FoundDrives {
  std::vector<DriveToWatch> drives;
  std::vector<std::string> notes;  ///< on the data: what was passed over
  Fnv hash;                        ///< of all files
};

/// Every car's drive in folders with CommonRoad files or the 100-Car study's release, until an
/// interrupt that is watched for.
/// @return  Error::Code::unreadable, ::malformed, naming file and reason, where a folder or file
///          cannot be read; ::too_late when interrupted. Set-based predictions are passed over
[[nodiscard]] Result<FoundDrives> find_drives(const std::vector<std::string>& folders);

/// Some of each source, as the seed has it.
/// @param count  of each source at most
[[nodiscard]] std::vector<DriveToWatch> drawn_drives(std::vector<DriveToWatch> all,
                                                     std::size_t count, std::uint64_t seed);

}  // namespace saca::suites
