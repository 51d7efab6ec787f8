#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/saca/inputs.h"
#include "saca/base/core/result.h"
#include "saca/lab/danger_study/weights.h"

namespace saca::app {

/// What a file of weights says, and the car that it is of.
struct DangerWeights : danger_study::Weights {
  Inputs inputs;
};

/// @return  an error naming file, tensor or word, wanted and got
[[nodiscard]] Result<DangerWeights> read_danger_weights(const std::string& path);

/// `saca danger check`.
void add_danger_check(CLI::App& danger, int& exit_code);
/// `saca danger coverage`.
void add_danger_coverage(CLI::App& danger, int& exit_code);
/// `saca danger margins`.
void add_danger_margins(CLI::App& danger, int& exit_code);
/// `saca danger show`.
void add_danger_show(CLI::App& danger, int& exit_code);

}  // namespace saca::app
