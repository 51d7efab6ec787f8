#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/families/family.h"

namespace saca::eval {

/// The cues of one encounter.
using DrawnCues = std::vector<families::DrawnCue>;

/// How often there were cues of a kind, and how often what they stand for came.
struct CueCount {
  int there = 0;
  int came = 0;

  /// Probability that it comes, by Jeffreys' prior: (came + 1/2) / (there + 1).
  [[nodiscard]] double probability() const { return (came + 0.5) / (there + 1.0); }
};

/// By world::CueKind.
using CueCounts = std::array<CueCount, world::num_cue_kinds>;

[[nodiscard]] CueCounts count_cues(std::span<const DrawnCues> encounters);

/// All who may come, counted together: the kinds for which the law has somebody.
[[nodiscard]] CueCount all_who_may_come(const CueCounts& counts, const intent::CueLaw& law);

/// What SACA is to reckon with: who comes and how as in `law`, how often as counted; a kind that
/// was not counted as often as all who may come together.
[[nodiscard]] intent::CueLaw counted_law(intent::CueLaw law, const CueCounts& counts);

/// A way to tell how likely it is that anything comes of an encounter's cues.
struct CueForecast {
  std::string_view key;    ///< as files have it
  std::string_view title;  ///< for readers
  Estimate log_loss;       ///< mean of -ln of the probability of what happened
  Estimate brier;          ///< mean square of probability less what happened
};

/// Four ways: the share of all encounters in which anything came; the table of counts by kind
/// (counted_law), cues independent of each other; logistic regression on the kinds (an intercept
/// with a prior of standard deviation 32, one weight for each kind with one of 1); the law that the
/// encounters were drawn by, which nobody who knows the kinds alone can beat but by chance.
/// @param learnt_from  what the first three know
/// @param judged       what all are held against, not empty
[[nodiscard]] std::vector<CueForecast> cue_forecasts(std::span<const DrawnCues> learnt_from,
                                                     std::span<const DrawnCues> judged,
                                                     const intent::CueLaw& law, std::uint64_t seed);

}  // namespace saca::eval
