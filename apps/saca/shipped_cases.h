#pragma once

#include <vector>

#include "apps/saca/places.h"
#include "saca/thinking/memory/case.h"

namespace saca::app {

/// The cases that are shipped (data/memory/seed.jsonl.gz): trusted by the car and the harm that
/// they were worked out with.
[[nodiscard]] Result<std::vector<memory::Case>> shipped_cases(const Places& places);

}  // namespace saca::app
