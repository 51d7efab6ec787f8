#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

// Each adds one subcommand of `saca reach`; exit codes as in `commands.h`.

void add_reach_check(CLI::App& reach, int& exit_code);
void add_reach_compare(CLI::App& reach, int& exit_code);
void add_reach_solve(CLI::App& reach, int& exit_code);
void add_reach_show(CLI::App& reach, int& exit_code);
void add_reach_tables(CLI::App& reach, int& exit_code);

}  // namespace saca::app
