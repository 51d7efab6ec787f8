#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

/// `saca memory add`.
void add_memory_add(CLI::App& memory, int& exit_code);

/// `saca memory build`.
void add_memory_build(CLI::App& memory, int& exit_code);

/// `saca memory calibrate`.
void add_memory_calibrate(CLI::App& memory, int& exit_code);

}  // namespace saca::app
