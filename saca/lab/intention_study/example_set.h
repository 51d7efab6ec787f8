#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/sequence_file.h"

namespace saca::intention_study {

/// What examples are made of.
struct ExampleRequest {
  std::vector<std::string> sets;  ///< files of recorded sets
  int parts = 5;                  ///< into so many the recordings are split, >= 1
  std::size_t simulated = 2'000;  ///< vehicles to train with; half as many to test with
  std::uint64_t seed = 1;         ///< of the simulated ones
};

/// What a model of intentions is trained and tested with: recorded sequences in splits "part-0",
/// "part-1" and so on, simulated ones as "simulated" and, of another seed, as "test".
/// @param threads  >= 1; the set is the same for any number
/// @return  what cannot be read of a recorded set
[[nodiscard]] Result<intention_scoring::SequenceSet> example_set(const ExampleRequest& request,
                                                                 int threads);

/// A table for people: of each split its sequences, groups and hours, and how many frames of each
/// class it has.
[[nodiscard]] std::string shares_text(const intention_scoring::SequenceSet& set);

}  // namespace saca::intention_study
