#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "saca/core/result.h"
#include "saca/danger/network.h"

namespace saca::app {

/// @param path  of the weights
/// @return      an error naming file, tensor, wanted and got
[[nodiscard]] Result<danger::Network> read_danger_network(const std::string& path);

/// `saca danger check`.
void add_danger_check(CLI::App& danger, int& exit_code);

}  // namespace saca::app
