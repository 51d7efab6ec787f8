#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <utility>

#include "saca/base/core/printable.h"

namespace saca::app {

/// Prints what a terminal may get, whatever a file, a path, a model or a server had in it: see
/// `printable`. All that the program says goes through here, but a story and a line of progress,
/// which have commands of their own.
/// @throws std::system_error  if it cannot be written
template <class... Args>
void print(std::FILE* file, fmt::format_string<Args...> format, Args&&... args) {
  fmt::print(file, "{}", printable(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  app::print(stdout, format, std::forward<Args>(args)...);
}

}  // namespace saca::app
