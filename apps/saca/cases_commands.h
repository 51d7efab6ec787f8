#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

/// `saca cases build`.
void add_cases_build(CLI::App& cases, int& exit_code);

/// `saca cases check`.
void add_cases_check(CLI::App& cases, int& exit_code);

/// `saca cases eval`.
void add_cases_eval(CLI::App& cases, int& exit_code);

/// `saca cases export`.
void add_cases_export(CLI::App& cases, int& exit_code);

/// `saca cases show`.
void add_cases_show(CLI::App& cases, int& exit_code);

}  // namespace saca::app
