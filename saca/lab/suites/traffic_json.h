#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/suites/traffic_watch.h"

namespace saca::suites {

/// What `saca suite traffic --json` prints: figures under the names of docs/formats.md.
/// @param version  of the program
[[nodiscard]] nlohmann::json traffic_json(const WatchedTraffic& traffic, const TrafficWatch& watch,
                                          const std::string& version);

}  // namespace saca::suites
