#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

// The parts of `saca intent` that stand in files of their own.

void add_intent_eval(CLI::App& intent, int& exit_code);
void add_intent_motion(CLI::App& intent, int& exit_code);
void add_intent_show(CLI::App& intent, int& exit_code);

}  // namespace saca::app
