#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/report/intention_page.h"

namespace saca::intention_study {

/// Which samples are drawn, to be judged by eye.
struct SampleRequest {
  std::string source;        ///< of the set, as its file is named
  std::string split;         ///< only of this one; empty: what was recorded
  std::string name;          ///< only the sequence of this name; empty: any
  std::size_t samples = 60;  ///< at most
  std::uint64_t seed = 1;
};

/// Numbers of sequences of the set: each class's turn comes as often as any other's, so that rare
/// ones are seen. A sequence counts for its rarest class. The same seed draws the same.
/// @return  empty: none fits
[[nodiscard]] std::vector<std::size_t> drawn_samples(const intention_scoring::SequenceSet& set,
                                                     const SampleRequest& request);

/// The sequences of these numbers.
[[nodiscard]] std::vector<intention_scoring::Sequence> sequences_of(
    const intention_scoring::SequenceSet& set, std::span<const std::size_t> chosen);

/// The page of samples that were drawn.
/// @param chosen     by drawn_samples()
/// @param forecasts  what a model believes of each of them; empty: there is none
[[nodiscard]] report::IntentionPage sample_page(
    const intention_scoring::SequenceSet& set, const SampleRequest& request,
    std::span<const std::size_t> chosen, std::span<const intention_scoring::Forecasts> forecasts);

}  // namespace saca::intention_study
