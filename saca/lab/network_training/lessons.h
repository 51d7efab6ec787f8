#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::network_training {

/// Knowledge distillation: what another model predicts of the sequences to be trained with, which
/// it must not have seen. Source: Hinton, Vinyals, Dean, Distilling the knowledge in a neural
/// network, arXiv:1503.02531.
struct Lessons {
  double share = 0.5;  ///< of the teacher in what a label is taken for, 0 ... 1
  /// One per sequence; without frames: of this one the labels alone are learnt. Empty: nobody
  /// teaches.
  std::vector<intention_scoring::Forecasts> forecasts;
};

/// What a file of format saca.forecasts/1 holds of sequences to be trained with.
/// @param held_out  what the network must not see; its teachers must not have seen it either
/// @return  a lesson for each sequence, without frames where the file has none of it. Malformed
///          where it has none at all, or predictions of one that is held out: whoever predicts each
///          part from all others has learnt from that one when it predicts the rest
[[nodiscard]] Result<Lessons> read_lessons(const std::filesystem::path& path,
                                           std::span<const intention_scoring::Sequence> sequences,
                                           std::span<const intention_scoring::Sequence> held_out);

}  // namespace saca::network_training
