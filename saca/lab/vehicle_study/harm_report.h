#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "saca/onboard/collision/harm.h"

namespace saca::vehicle_study {

/// The document of `saca harm --json`, schema saca.harm/1: the risk curves of a harm model at a few
/// speeds, 10 to 100 km/h. docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const collision::HarmModel& model);

/// The same for people, as two tables.
/// @param file  that the model stands in
[[nodiscard]] std::string text_of(const collision::HarmModel& model, std::string_view file);

}  // namespace saca::vehicle_study
