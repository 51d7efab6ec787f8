#pragma once

#include <iosfwd>

#include "engine.h"

namespace saca::model_host {

/// Answers requests until the input ends. Each line out is whole and flushed.
/// @param in  file descriptor; looked at during an ask, too, which may be cancelled there
/// @return  exit code: 0 when the input ended, 1 when the model cannot be loaded
int serve(const EngineSettings& settings, int in, std::ostream& out);

}  // namespace saca::model_host
