#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::formats {

// A file whose first 512 bytes tell its format, and size and check sum of the rest: damage of any
// kind is found before a library sees the file. HDF5 calls such a head a user block and passes over
// it.

/// Puts head and body at `path` in one step: readers see the old file or the whole new one, also
/// after a kill.
///
/// @param format  such as "saca.value/2": a name, a slash and a version, of at most 64 bytes
/// @return        nullopt when it is on the disk, else the reason
/// @throws ContractViolation  if the format is not like that
[[nodiscard]] std::optional<Error> write_checksummed(const std::filesystem::path& path,
                                                     std::string_view format,
                                                     std::string_view body);

/// @return  nullopt when the file is whole and of this format; else unreadable, or malformed: one
///          line that tells another version from another kind of file and from a damaged one
[[nodiscard]] std::optional<Error> verify_checksum(const std::filesystem::path& path,
                                                   std::string_view format);

}  // namespace saca::formats
