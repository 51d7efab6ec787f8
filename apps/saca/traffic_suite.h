#pragma once

#include "apps/saca/traffic_watching.h"

namespace saca::app {

/// `saca suite traffic`: watches, writes page and figures beside `options.output`, prints.
/// @return  exit code
[[nodiscard]] int run_traffic_suite(const TrafficWatch& options, bool as_json);

}  // namespace saca::app
