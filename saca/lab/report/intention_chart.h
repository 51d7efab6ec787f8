#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "saca/lab/report/svg.h"
#include "saca/thinking/intent/observation.h"

namespace saca::report {

/// A vehicle's six intentions, in eq. 5's order: what charts of them show.
constexpr std::size_t charted_intentions = 6;
using IntentionShares = std::array<double, charted_intentions>;

/// What a model believed over time.
struct IntentionBand {
  std::string name;                     ///< "now", "in 1 s"
  std::vector<IntentionShares> shares;  ///< one per observation, each with sum 1
};

/// One vehicle over time: what was seen of it, what it did, what was believed of it.
struct IntentionSample {
  std::string title;
  std::vector<std::string> lines;  ///< below it
  double step = 0.1;               ///< from observation to observation [s], > 0
  std::vector<intent::Observation> seen;
  std::vector<std::size_t> labels;   ///< as `intent::Intention`, one per observation
  std::vector<bool> scored;          ///< likewise; false: the label is in doubt, it is drawn pale
  std::vector<double> marks;         ///< instants to be marked: crossings, onsets of braking [s]
  std::vector<IntentionBand> bands;  ///< may be none
};

/// Way to the left since the first place that is known, which stays at its offset: a jump by about
/// a lane's width is another lane, not another place [m]. NaN on no lane.
[[nodiscard]] std::vector<double> unwrapped_offsets(
    const std::vector<intent::Observation>& observations);

/// How big a sample is when it is drawn.
[[nodiscard]] SvgSize intention_sample_size(const IntentionSample& sample);

/// The place across the lanes with their bounds, speed and acceleration over time; a band with the
/// labels' colours; below, the beliefs as stacked bands. No document of its own: a part at the
/// origin.
/// @throws ContractViolation  if there is no observation, a label is none, or parts differ in
/// length
[[nodiscard]] std::string intention_sample_part(const IntentionSample& sample);
/// The same as a whole file, with its legend.
[[nodiscard]] std::string intention_sample_svg(const IntentionSample& sample);

/// What each colour means, in one line.
[[nodiscard]] std::string intention_legend(Vec2 at);
constexpr SvgSize intention_legend_size{600.0, 22.0};

/// How often what was said of what, as a coloured table: a row is one truth.
struct ConfusionChart {
  std::string title;
  std::vector<std::string> lines;  ///< below it
  /// [truth][predicted]
  std::array<std::array<std::size_t, charted_intentions>, charted_intentions> counts{};
};

/// Each cell with its share of its row and its count; rows without any stay empty.
[[nodiscard]] std::string confusion_svg(const ConfusionChart& chart);

}  // namespace saca::report
