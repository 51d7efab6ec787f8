#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "saca/core/result.h"
#include "saca/learn/score.h"
#include "saca/learn/sequence.h"

namespace saca::train {

/// What another model foretells of the sequences to be trained with, which it must not have seen:
/// to learn from a teacher as well as from labels is to be told how sure one can be. Source:
/// Hinton, Vinyals, Dean, Distilling the knowledge in a neural network, arXiv:1503.02531.
struct Lessons {
  double share = 0.5;  ///< of the teacher in what a label is taken for, 0 ... 1
  /// One per sequence; without frames: of this one the labels alone are learnt. Empty: nobody
  /// teaches.
  std::vector<learn::Forecasts> forecasts;
};

/// What a file of format saca.forecasts/1 holds of sequences to be trained with.
/// @param held_out  what the network must not see; its teachers must not have seen it either
/// @return  a lesson for each sequence, without frames where the file has none of it. Malformed
///          where it has none at all, or forecasts of one that is held out: each part is foretold
///          by who has learnt from all others, so that those of the rest have learnt from this one
[[nodiscard]] Result<Lessons> read_lessons(const std::filesystem::path& path,
                                           std::span<const learn::Sequence> sequences,
                                           std::span<const learn::Sequence> held_out);

}  // namespace saca::train
