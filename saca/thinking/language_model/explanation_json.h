#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "saca/thinking/language_model/explanation.h"

namespace saca::language_model {

/// As records and `saca reason --json` have it (docs/formats.md); null where there is none.
[[nodiscard]] inline nlohmann::json explanation_json(const std::optional<Explanation>& told) {
  return told ? nlohmann::json{{"text", told->text},
                               {"from", name(told->from)},
                               {"tries", told->tries}}
              : nlohmann::json();
}

}  // namespace saca::language_model
