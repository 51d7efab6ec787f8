#pragma once

#include "saca/lab/suites/traffic_watch.h"

namespace saca::app {

/// `saca suite traffic`: watches, writes page and figures beside `watch.output`, prints.
/// @return  exit code
[[nodiscard]] int run_traffic_suite(const suites::TrafficWatch& watch, bool as_json);

}  // namespace saca::app
