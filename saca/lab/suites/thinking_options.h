#pragma once

#include <string>

namespace saca::suites {

/// What SACA thinks with, as commands name it.
struct ThinkingOptions {
  std::string memory;         ///< file of the memory bank; empty: none
  std::string model = "off";  ///< as `--llm` takes it
  /// Likewise, of methods that ask a model as it was before it was taught; empty: none.
  std::string untuned;
};

/// All as they were given, to be part of a command; empty where none was.
[[nodiscard]] std::string thinking_text(const ThinkingOptions& thinking);

}  // namespace saca::suites
