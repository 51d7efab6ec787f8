#pragma once

#include <string_view>

#include "saca/core/result.h"

/// What all training programs share: how they begin, are stopped and end.
namespace saca::train_program {

constexpr int success = 0;

/// To be called first in main: each thread multiplies matrices by itself, so that the same seed
/// gives the same bytes, and Ctrl-C is heard.
void begin(char** argv);

/// Whether Ctrl-C was pressed.
[[nodiscard]] bool is_to_stop();

/// Says what is wrong.
/// @return  the exit code that goes with it
[[nodiscard]] int failed(std::string_view program, const Error& error);

/// Says that it was stopped.
/// @return  likewise
[[nodiscard]] int stopped(std::string_view program);

}  // namespace saca::train_program
