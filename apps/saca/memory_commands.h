#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>

#include "apps/saca/planes_making.h"
#include "saca/lab/banks/case_tools.h"

namespace saca::app {

/// What cases are worked out with there; the planes outlive it.
[[nodiscard]] banks::CaseTools case_tools(const PlanesOfCar& planes, std::size_t draws);

/// `saca memory add`.
void add_memory_add(CLI::App& memory, int& exit_code);

/// `saca memory build`.
void add_memory_build(CLI::App& memory, int& exit_code);

/// `saca memory check`.
void add_memory_check(CLI::App& memory, int& exit_code);

/// `saca memory calibrate`.
void add_memory_calibrate(CLI::App& memory, int& exit_code);

/// `saca memory stats`.
void add_memory_stats(CLI::App& memory, int& exit_code);

}  // namespace saca::app
