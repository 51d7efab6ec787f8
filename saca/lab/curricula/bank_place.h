#pragma once

#include <filesystem>
#include <optional>

#include "saca/base/core/result.h"

namespace saca::curricula {

/// A bank that lies where banks are replaced.
/// @param bank    that memories begin with; empty: none
/// @param folder  of the banks that are made
/// @return        nullopt: it lies elsewhere, else Error::Code::out_of_range
[[nodiscard]] std::optional<Error> why_in_the_way(const std::filesystem::path& bank,
                                                  const std::filesystem::path& folder);

}  // namespace saca::curricula
