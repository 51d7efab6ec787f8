#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/traffic_watch.h"

namespace saca::suites {

/// The page of `saca suite traffic`: rates, every trigger and every time that SACA acts, false ones
/// first, with pictures of the first 150.
/// @param tools    what was watched with
/// @param figures  as traffic_json: what it says of how they were made stands below
[[nodiscard]] report::SuitePage traffic_page(const WatchedTraffic& traffic, const WatchTools& tools,
                                             const nlohmann::json& figures);

}  // namespace saca::suites
