#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"

namespace saca::memory {

/// A case as one JSON document, all of it: schema "saca.case/1", see docs/formats.md. Every number
/// comes back to the last bit.
/// @throws ContractViolation  if the scene breaks a rule of `world::broken_rule`
[[nodiscard]] nlohmann::json to_json(const Case& one);

/// Strict, as `scene_from_json`.
/// @return  Error::Code::malformed, naming the key, what was wanted, what came
[[nodiscard]] Result<Case> case_from_json(const nlohmann::json& document);

/// What of a case the memory bank keeps in one column, `details`: everything that version 2 of it
/// did not know. What is as in a case of version 2 is left out.
[[nodiscard]] nlohmann::json details_json(const Case& one);
/// Takes it over into a case whose other fields are known; `broken_rule` looks at the whole.
/// @return  as `case_from_json`; nullopt: nothing is wrong
[[nodiscard]] std::optional<Error> read_details(const nlohmann::json& details, Case& one);

/// Cases as JSON Lines: one line that says what follows and how many, then one per case.
[[nodiscard]] std::string cases_text(std::span<const Case> cases);

/// @param name  of the file, for messages
/// @return      malformed, naming file, line and key: also where a line is missing, or an id comes
///              twice
[[nodiscard]] Result<std::vector<Case>> cases_from_text(std::string_view text,
                                                        const std::string& name);

}  // namespace saca::memory
