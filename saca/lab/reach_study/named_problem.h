#pragma once

#include <string>

#include "saca/lab/installation/installation.h"
#include "saca/lab/levelset/solve.h"

namespace saca::reach_study {

/// A problem by its file, by the name of a shipped one (`data/reach`), or `air3d`.
[[nodiscard]] Result<levelset::Problem> named_problem(const installation::Installation& here,
                                                      const std::string& name);

}  // namespace saca::reach_study
