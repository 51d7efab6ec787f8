#pragma once

#include <string>

#include "saca/lab/policy_study/whatif_cells.h"

namespace saca::policy_study {

/// The map as SVG: over two numbers areas in the policies' colours, over one a strip with the harm
/// of each policy.
[[nodiscard]] std::string whatif_svg(const WhatifMap& map);

}  // namespace saca::policy_study
