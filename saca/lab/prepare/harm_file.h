#pragma once

#include <filesystem>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/onboard/collision/harm.h"

namespace saca::prepare {

/// Reads data/harm.toml: how contact becomes harm.
/// @param source  name for messages, usually the path
/// @return        Error::Code::malformed or out_of_range, naming source, line and key
[[nodiscard]] Result<collision::HarmModel> parse_harm(std::string_view text,
                                                      std::string_view source);
[[nodiscard]] Result<collision::HarmModel> read_harm(const std::filesystem::path& path);

}  // namespace saca::prepare
