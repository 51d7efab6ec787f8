#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::verification {

/// Numbers as NumPy writes them.
struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> values;  ///< row-major, whatever the file's order; all finite
};

/// One .npy file: version 1 to 3 of the format, little-endian floats of 4 or 8 bytes.
///
/// @param source  where it is from, for messages
/// @return        Error::Code::malformed, which names the source, what is wanted and what came
[[nodiscard]] Result<NpyArray> parse_npy(std::string_view bytes, const std::string& source);

/// All arrays of an .npz (zip) file by name, "weights" for the entry "weights.npy".
///
/// @param source  where it is from, for messages
/// @return        Error::Code::malformed, which names source and entry. Refused too: no entry or
///                more than 256, entries beyond 64 MiB
[[nodiscard]] Result<std::map<std::string, NpyArray>> parse_npz(std::string_view bytes,
                                                                const std::string& source);

/// The same for a file of at most 64 MiB.
/// @return  Error::Code::unreadable too
[[nodiscard]] Result<std::map<std::string, NpyArray>> read_npz(const std::filesystem::path& path);

}  // namespace saca::verification
