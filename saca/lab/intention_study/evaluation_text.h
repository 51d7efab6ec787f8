#pragma once

#include <string>

#include "saca/lab/intention_study/evaluation.h"

namespace saca::intention_study {

/// The figures of an evaluation for people: a table of each comparison, our confusion at each
/// horizon, what of each act we find and when, our differences to all others; in the end how far
/// from where they will be our forecasts see vehicles. "-": there is no such figure.
[[nodiscard]] std::string evaluation_text(const Evaluation& evaluation);

}  // namespace saca::intention_study
