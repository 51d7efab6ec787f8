#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::long_work {

/// Before long work: why one of the files that it is to leave could not be written
/// (`why_unwritable`). An empty name is none.
[[nodiscard]] std::optional<Error> why_outputs_unwritable(
    std::initializer_list<std::filesystem::path> files);

/// `write_file`, with the folder made that the file is to lie in.
[[nodiscard]] std::optional<Error> write_output(const std::filesystem::path& file,
                                                std::string_view text);

/// Makes the folder that `file` is to lie in.
/// @return  Error::Code::unwritable where it cannot be made
[[nodiscard]] std::optional<Error> make_folder_of(const std::filesystem::path& file);

}  // namespace saca::long_work
