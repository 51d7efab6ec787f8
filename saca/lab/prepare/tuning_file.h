#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/tuning.h"

namespace saca::prepare {

/// Reads what `tuning_text` writes.
/// @return  Error::Code::unreadable; malformed, naming file, line and key
[[nodiscard]] Result<manoeuvre::Tuning> read_tuning(const std::filesystem::path& path);

/// The file's text, all digits of every number. `comment` goes on top: how the numbers were found.
[[nodiscard]] std::string tuning_text(const manoeuvre::Tuning& tuning, std::string_view comment);

}  // namespace saca::prepare
