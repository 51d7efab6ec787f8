#pragma once

#include <string>
#include <string_view>

namespace saca::report {

/// Bytes as letters for `data:` addresses (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace saca::report
