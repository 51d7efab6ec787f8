#pragma once

#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::language_model {

/// Where a server with `base` takes questions: `<base>/chat/completions`.
///
/// @param base      e.g. "https://api.openai.com/v1": http or https, without user, query, fragment
/// @param with_key  a key goes along: plain http then reaches this machine only (127.0.0.1, ::1,
///                  localhost)
/// @return          malformed, saying what was wanted; never shows user or password
[[nodiscard]] Result<std::string> chat_address(std::string_view base, bool with_key);

/// `base` for people: without user and password, in one line.
[[nodiscard]] std::string shown_address(std::string_view base);

}  // namespace saca::language_model
