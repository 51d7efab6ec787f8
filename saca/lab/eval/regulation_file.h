#pragma once

#include <filesystem>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/lab/eval/regulation.h"

namespace saca::eval {

/// @param source  name for messages, usually the path
/// @return        Error::Code::malformed, naming source, line, key, wanted and got
[[nodiscard]] Result<Regulation> read_regulation(std::string_view text, std::string_view source);
/// @return  as read_regulation, or Error::Code::unreadable
[[nodiscard]] Result<Regulation> load_regulation(const std::filesystem::path& path);

}  // namespace saca::eval
