#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/traffic_recording.h"

namespace saca::importers {

/// The document of `saca import 100car --all --json`: schema saca.hundred_car_import/1.
[[nodiscard]] nlohmann::json import_json(const std::vector<HundredCarOutcome>& outcomes);

/// The document of `saca import commonroad --json`: schema saca.traffic_import/1.
/// @param output  file of the scenario
[[nodiscard]] nlohmann::json import_json(const TrafficImport& made, const TrafficRequest& request,
                                         const std::string& output);

}  // namespace saca::importers
