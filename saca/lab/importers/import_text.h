#pragma once

#include <string>
#include <vector>

#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/traffic_recording.h"

namespace saca::importers {

// What was made of recordings, for people.

/// Of one event of the 100-Car study.
/// @param output  file of the scenario
[[nodiscard]] std::string import_text(const HundredCarReport& report,
                                      const HundredCarRequest& request, const std::string& output);

/// Of a whole release: how many events were rebuilt, and how many refused for which reason.
[[nodiscard]] std::string import_text(const std::vector<HundredCarOutcome>& outcomes);

/// Of recorded traffic: whom it holds, how well its lane fits, what was smoothed, left out and
/// ignored.
[[nodiscard]] std::string import_text(const TrafficImport& made, const TrafficRequest& request,
                                      const std::string& output);

}  // namespace saca::importers
