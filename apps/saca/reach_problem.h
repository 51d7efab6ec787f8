#pragma once

#include <string>

#include "apps/saca/places.h"
#include "saca/core/result.h"
#include "saca/reach/solve.h"

namespace saca::app {

/// A problem by its file's path, by the name of a shipped one (`data/reach`), or `air3d`.
[[nodiscard]] Result<reach::Problem> find_problem(const Places& places, const std::string& name);

}  // namespace saca::app
