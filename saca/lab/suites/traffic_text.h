#pragma once

#include <string>

#include "saca/lab/eval/rate.h"
#include "saca/lab/suites/traffic_watch.h"

namespace saca::suites {

/// A rate with its interval, for readers: "1.2 (0.4 to 2.6)".
[[nodiscard]] std::string with_bounds(const eval::Rate& rate);

/// What `saca suite traffic` prints for people: rates of each source and of all, and why it
/// triggered and acted.
[[nodiscard]] std::string traffic_text(const WatchedTraffic& traffic);

}  // namespace saca::suites
