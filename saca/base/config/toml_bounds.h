#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace saca::config {

/// How much TOML is read. The parser, and what walks and destroys a document, need stack for each
/// level, so depth is bounded before anything is made of a text.
struct TomlBounds {
  std::size_t depth = 32;                      ///< of arrays and inline tables, and parts of a key
  std::size_t bytes = std::size_t{16} << 20U;  ///< of the text; ours have 100 KiB
};

/// What of a text breaks the bounds.
struct TomlExcess {
  std::size_t line = 1;
  std::string message;  ///< "want ..., got ..."
};

/// @param text  need not be TOML
/// @return      nullopt where a parser, up to the first thing that is no TOML, stays within them
[[nodiscard]] std::optional<TomlExcess> beyond(const TomlBounds& bounds, std::string_view text);

}  // namespace saca::config
