#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {

/// What `build` or `export` wrote.
[[nodiscard]] Result<std::vector<memory::Case>> read_cases(const std::string& file);

/// The bank that cases are added to; one that is not there is made, with its folder.
[[nodiscard]] Result<memory::Store> open_to_add(const std::string& file);

/// An existing bank and all its cases.
struct ReadBank {
  memory::Store store;
  std::vector<memory::Case> cases;
};
/// To look must not make one: unreadable where there is none.
[[nodiscard]] Result<ReadBank> read_bank(const std::string& file);

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
