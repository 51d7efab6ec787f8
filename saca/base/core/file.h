#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca {

/// As much as a file may hold that is read whole, unless its reader wants more: what people write
/// has a few KiB [bytes].
constexpr std::uintmax_t usual_bytes = std::uintmax_t{64} << 20U;
/// For sets, weights, tapes and journals [bytes].
constexpr std::uintmax_t many_bytes = std::uintmax_t{4} << 30U;

/// The whole file as bytes. A device or a pipe is none: it may never end, or never begin.
/// @param most  bytes; a longer file is refused before it is read
/// @return      Error::Code::unreadable, naming the path and the system's reason
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uintmax_t most = usual_bytes);

/// Hands a file's bytes on, at most a MiB at once, however many there are.
/// @return  nullopt when all have been taken, else the error, as above
[[nodiscard]] std::optional<Error> read_file(const std::filesystem::path& path,
                                             const std::function<void(std::string_view)>& take);

/// Puts `text` at `path` in one step: a reader sees the old file or the whole new one, also after a
/// crash or on a full disk, where the old file stays and nothing half-written is left. What a link
/// leads to is replaced, not the link. A character device (/dev/null) is written into; a pipe, a
/// socket or a disk is refused.
///
/// @return  nullopt when the file is on the disk, else the error (Error::Code::unwritable)
[[nodiscard]] std::optional<Error> write_file(const std::filesystem::path& path,
                                              std::string_view text);
/// Likewise a text that lies in parts.
[[nodiscard]] std::optional<Error> write_file(const std::filesystem::path& path,
                                              std::initializer_list<std::string_view> parts);

/// Whether `write_file` could put a file at `path` once the folders on the way there are made: to
/// be asked before work whose result is to lie there. It is tried, and nothing is left of it.
///
/// @return  nullopt when it could, else the error (Error::Code::unwritable)
[[nodiscard]] std::optional<Error> why_unwritable(const std::filesystem::path& path);

}  // namespace saca
