#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "saca/lab/verification/physics_figures.h"

namespace saca::vehicle_study {

/// The figures of `saca physics --json`, each with its band and its reference, and how many lie
/// outside: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const std::vector<verification::Figure>& figures);

/// The same for people.
[[nodiscard]] std::string text_of(const std::vector<verification::Figure>& figures);

}  // namespace saca::vehicle_study
