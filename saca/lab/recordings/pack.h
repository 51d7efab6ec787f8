#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/recordings/recorded_set.h"
#include "saca/lab/recordings/repeats.h"

namespace saca::recordings {

/// Told after each file: how many of how many are done. False: stop.
using PackProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// A set, and what could not go into it.
struct PackResult {
  RecordedSet set;
  std::vector<std::string> refused;  ///< messages of files that no reader takes, one line each
  Repeats repeats;
};

/// All files with this ending (".xml") in or below the places, in the order of their names; a place
/// may be a file itself, whatever its ending.
/// @return  Error::Code::unreadable, naming a place that is not there
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_in(
    const std::vector<std::filesystem::path>& places, const std::string& ending);

/// CommonRoad files as a set: groups named, repeats dropped (repeats.h). Set-based predictions and
/// files that cannot be read are counted in `skipped`; the latter are told in `refused`.
///
/// @return  Error::Code::malformed when no file gave a vehicle, Error::Code::too_late when stopped
[[nodiscard]] Result<PackResult> pack_commonroad(const std::vector<std::filesystem::path>& files,
                                                 const PackProgress& progress);

/// Events of the 100-Car study as a set, the car of each (hundred_car_set.h).
/// @param files  of the release: the table of events (100CarEventVideoReducedData_v1_5.txt) and the
///               series (HundredCar_*.txt), one event's or many events' rows; others are passed
///               over
/// @return       as above; Error::Code::malformed also without a table
[[nodiscard]] Result<PackResult> pack_hundred_car(const std::vector<std::filesystem::path>& files,
                                                  const PackProgress& progress);

/// NGSIM's own files as a set (ngsim_csv.h, ngsim_set.h); what several files hold of one recording
/// goes together.
/// @return  as above; also the first error of a file: who packs a gigabyte wants it whole
[[nodiscard]] Result<PackResult> pack_ngsim(const std::vector<std::filesystem::path>& files,
                                            const PackProgress& progress);

}  // namespace saca::recordings
