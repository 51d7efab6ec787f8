#pragma once

#include <iosfwd>

#include "engine.h"

namespace saca::model_host {

/// Asks `runs` times with one scene and with three, through the child process, and prints times,
/// rates and memory.
/// @param json  as one flat object instead of lines
/// @return      exit code
int bench(const EngineSettings& settings, int runs, bool json, std::ostream& out);

}  // namespace saca::model_host
