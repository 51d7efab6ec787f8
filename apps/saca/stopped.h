#pragma once

#include "apps/saca/places.h"

namespace saca::app {

/// As `refused`; of work that was interrupted (Error::Code::too_late) the exit code says that.
[[nodiscard]] inline int stopped(const Error& problem) {
  const int code = refused(problem);
  return problem.code == Error::Code::too_late ? static_cast<int>(was_interrupted) : code;
}

}  // namespace saca::app
