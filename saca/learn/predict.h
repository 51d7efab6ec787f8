#pragma once

#include <span>
#include <vector>

#include "saca/intent/model.h"
#include "saca/learn/score.h"
#include "saca/learn/sequence.h"

namespace saca::learn {

/// What a model tells while it watches each sequence from its beginning.   (one per sequence)
/// @param threads  >= 1; the result is the same for any number
[[nodiscard]] std::vector<Forecasts> predicted(const intent::Model& model,
                                               std::span<const Sequence> sequences, int threads);

}  // namespace saca::learn
