#pragma once

#include "saca/thinking/arbitration/forecaster.h"

namespace saca::arbitration {

/// Memoisation: a judge that works out each verdict once, for several that judge the same scenes,
/// as the methods of a comparison do until one of them acts. What it returns is what `judge`
/// returned for equal arguments; copies of it share what they know. Keeps every verdict, some
/// 10 KiB each. For one thread.
/// @param judge  not empty; the same arguments give the same verdict
[[nodiscard]] Judge memoised(Judge judge);

}  // namespace saca::arbitration
