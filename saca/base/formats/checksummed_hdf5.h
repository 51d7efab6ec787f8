#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "saca/base/core/result.h"
#include "saca/base/formats/checksummed_file.h"
#include "saca/base/formats/hdf5_reader.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::formats {

// HDF5 files with the head of a checksummed file; their attribute `format` says the same once more.

/// Puts what was written, and the format, at `path`, in one step.
/// @return  nullopt when it is on the disk, else the reason
inline std::optional<Error> write_sealed_hdf5(const std::filesystem::path& path,
                                              std::string_view format, Hdf5Writer& writer) {
  writer.attribute(".", "format", std::string(format));
  const std::optional<std::string_view> body = writer.bytes();
  if (!body) {
    return Error{Error::Code::unwritable, path.string() + ": HDF5 cannot make the file in memory"};
  }
  return write_checksummed(path, format, *body);
}

/// What `read` makes of the file, unless its seal, its format or something that was read is wrong.
/// @param read  takes a `Hdf5Reader&`, returns a value
template <class Read>
[[nodiscard]] auto read_sealed_hdf5(const std::filesystem::path& path, std::string_view format,
                                    const Read& read)
    -> Result<std::invoke_result_t<const Read&, Hdf5Reader&>> {
  if (const auto problem = verify_checksum(path, format)) {
    return *problem;
  }
  try {
    Hdf5Reader reader(path.string(), path);
    const std::string came = reader.text_attribute(".", "format");
    if (!reader.problem() && came != format) {
      reader.reject("attribute format", std::string(format), came);
    }
    auto all = read(reader);
    if (reader.problem()) {
      return *reader.problem();
    }
    return all;
  } catch (const std::exception& problem) {  // of a file that asks for more memory than there is
    return Error{Error::Code::unreadable,
                 path.string() + ": cannot be read: " + std::string(problem.what())};
  }
}

}  // namespace saca::formats
