#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "saca/reason/explanation.h"

namespace saca::reason {

/// As records and `saca reason --json` have it (docs/formats.md); null where there is none.
[[nodiscard]] inline nlohmann::json explanation_json(const std::optional<Explanation>& told) {
  return told ? nlohmann::json{{"text", told->text}, {"from", name(told->from)}} : nlohmann::json();
}

}  // namespace saca::reason
