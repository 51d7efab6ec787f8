#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/cases/chat_set.h"

namespace saca::cases {

/// One set of `saca cases check --json` (docs/formats.md).
/// @param file  of the set
[[nodiscard]] nlohmann::json chat_set_json(const std::string& file, const ChatSetFigures& figures);

/// The same as a line.
[[nodiscard]] std::string chat_set_text(const std::string& file, const ChatSetFigures& figures);

}  // namespace saca::cases
