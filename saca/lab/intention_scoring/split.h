#pragma once

#include <span>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring {

/// Which part each sequence belongs to, 0 to `num_parts` - 1. Groups are never divided; each site's
/// groups are dealt out so that every part gets about as much of what is rare: the groups with the
/// most frames other than M first, each to the part that has the least so far. Same sequences, same
/// parts.
/// @param num_parts  >= 1
[[nodiscard]] std::vector<int> parts_of(std::span<const Sequence> sequences, int num_parts);

/// The sequences of one part, and all others.
struct Split {
  std::vector<Sequence> part;
  std::vector<Sequence> rest;
};
[[nodiscard]] Split split_off(std::vector<Sequence> sequences, int part, int num_parts);

}  // namespace saca::intention_scoring
