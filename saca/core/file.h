#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "saca/core/result.h"

namespace saca {

/// The whole file as bytes; no device.
/// @return  Error::Code::unreadable, naming the path and the system's reason
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// Hands a file's bytes on, at most a MiB at once.
/// @return  nullopt when all have been taken, else the error, as above
[[nodiscard]] std::optional<Error> read_file(const std::filesystem::path& path,
                                             const std::function<void(std::string_view)>& take);

/// Puts `text` at `path` in one step: a reader sees the old file or the whole new one, also after a
/// crash or on a full disk, where the old file stays and nothing half-written is left.
///
/// @return  nullopt when the file is on the disk, else the error (Error::Code::unwritable)
[[nodiscard]] std::optional<Error> write_file(const std::filesystem::path& path,
                                              std::string_view text);
/// Likewise a text that lies in parts.
[[nodiscard]] std::optional<Error> write_file(const std::filesystem::path& path,
                                              std::initializer_list<std::string_view> parts);

}  // namespace saca
