#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/network_training/task.h"

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

/// Prints an epoch of so many.
/// @return  whether to go on
[[nodiscard]] bool show_epoch(const network_training::Epoch& now, int epochs);

/// Writes the weights, and beside them ("....curve.csv") the curve.
[[nodiscard]] std::optional<Error> write_trained(const std::string& output,
                                                 const formats::Tensors& weights,
                                                 std::string_view curve);

/// Says that it was stopped.
/// @return  likewise
[[nodiscard]] int stopped(std::string_view program);

}  // namespace saca::train_program
