#pragma once

#include <span>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring {

/// What a model tells while it watches each sequence from its beginning.   (one per sequence)
/// @param threads  >= 1; the result is the same for any number
[[nodiscard]] std::vector<Forecasts> predicted(const intent::Model& model,
                                               std::span<const Sequence> sequences, int threads);

}  // namespace saca::intention_scoring
