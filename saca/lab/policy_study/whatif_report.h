#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/policy_study/whatif_cells.h"

namespace saca::policy_study {

/// The document of `saca whatif --json`, schema saca.whatif/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const WhatifMap& map);

/// For people: how often each policy is best, cannot be driven, and how often the scene cannot be.
[[nodiscard]] std::string text_of(const WhatifMap& map);

}  // namespace saca::policy_study
