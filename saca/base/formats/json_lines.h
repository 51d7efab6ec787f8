#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::formats {

// A file of JSON Lines: the first line is { "schema": what follows, WORD: how many }, then each
// line is one document.

/// The first line, with its end.
/// @param word  what is counted, e.g. "cases"
[[nodiscard]] std::string first_json_line(std::string_view schema, std::string_view word,
                                          std::size_t count);

/// @param name  of the file, for messages
/// @param take  of each document after the first line: why it is refused; nullopt: it is not
/// @return      malformed, naming file, line and what is wrong: no JSON, another schema, what is
///              refused, fewer or more documents than the first line says; nullopt: all was taken
[[nodiscard]] std::optional<Error> read_json_lines(
    std::string_view text, const std::string& name, std::string_view schema,
    const std::string& word,
    const std::function<std::optional<std::string>(const nlohmann::json&)>& take);

}  // namespace saca::formats
