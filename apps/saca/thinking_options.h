#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace saca::app {

/// `--memory` and `--llm`: what SACA thinks with.
struct ThinkingOptions {
  std::string memory;         ///< file of the memory bank; empty: none
  std::string model = "off";  ///< as model_access::open_model takes it
  /// Likewise, of methods that ask a model as it was before it was taught; empty: none.
  std::string untuned;
};

/// Adds both, with what `options` holds as their defaults.
void add_thinking_options(CLI::App& command, ThinkingOptions& options);

/// Adds `--untuned`.
void add_untuned_option(CLI::App& command, ThinkingOptions& options);

/// All as they were given, to be part of a command; empty where none was.
[[nodiscard]] std::string thinking_text(const ThinkingOptions& thinking);

}  // namespace saca::app
