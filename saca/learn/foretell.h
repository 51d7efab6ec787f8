#pragma once

#include <array>
#include <span>
#include <vector>

#include "saca/intent/model.h"
#include "saca/learn/score.h"
#include "saca/learn/sequence.h"

namespace saca::learn {

/// What a model tells while it watches each sequence from its beginning.   (one per sequence)
/// @param threads  >= 1; the result is the same for any number
[[nodiscard]] std::vector<Forecasts> foretold(const intent::Model& model,
                                              std::span<const Sequence> sequences, int threads);

/// The sharpness of each horizon under which the labels are likeliest: temperature scaling.
/// Source: Guo et al., On calibration of modern neural networks, ICML 2017.
/// @param forecasts  of a model with sharpness 1, one per sequence
/// @return           between 1/8 and 8
[[nodiscard]] std::array<double, intent::num_horizons> best_sharpness(
    std::span<const Sequence> sequences, std::span<const Forecasts> forecasts);

}  // namespace saca::learn
