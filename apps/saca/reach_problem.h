#pragma once

#include <string>

#include "apps/saca/places.h"
#include "saca/base/core/result.h"
#include "saca/lab/levelset/solve.h"

namespace saca::app {

/// A problem by its file's path, by the name of a shipped one (`data/reach`), or `air3d`.
[[nodiscard]] Result<levelset::Problem> find_problem(const Places& places, const std::string& name);

}  // namespace saca::app
