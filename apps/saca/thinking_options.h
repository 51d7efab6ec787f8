#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace saca::app {

/// `--memory` and `--llm`: what SACA thinks with.
struct ThinkingOptions {
  std::string memory;         ///< file of the memory bank; empty: none
  std::string model = "off";  ///< as ChosenModel::open takes it
};

/// Adds both, with what `options` holds as their defaults.
void add_thinking_options(CLI::App& command, ThinkingOptions& options);

/// Both as they were given, to be part of a command; empty where neither was.
[[nodiscard]] std::string thinking_text(const ThinkingOptions& thinking);

}  // namespace saca::app
