#pragma once

#include <CLI/CLI.hpp>

#include "saca/lab/suites/thinking_options.h"

namespace saca::app {

using suites::thinking_text;
using suites::ThinkingOptions;

/// Adds `--memory` and `--llm`: what SACA thinks with, with what `options` holds as their defaults.
void add_thinking_options(CLI::App& command, ThinkingOptions& options);

/// Adds `--untuned`.
void add_untuned_option(CLI::App& command, ThinkingOptions& options);

}  // namespace saca::app
