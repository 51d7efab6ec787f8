#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "saca/base/core/result.h"

namespace saca::formats {

/// The text of a file that gzip may have compressed (RFC 1952); one that is not is read as it is.
///
/// @param most  of the text [byte]
/// @return      as `read_file`; Error::Code::malformed when it is damaged, ends too soon, or holds
///              more than `most`
[[nodiscard]] Result<std::string> read_compressed(const std::filesystem::path& file,
                                                  std::size_t most);

}  // namespace saca::formats
