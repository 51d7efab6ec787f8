#pragma once

#include <CLI/CLI.hpp>

#include "apps/saca/places.h"

namespace saca::app {

// Subcommands of `saca model`.
void add_model_bench(CLI::App& model, int& exit_code);
void add_model_score(CLI::App& model, int& exit_code);

}  // namespace saca::app
