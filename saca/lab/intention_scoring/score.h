#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring {

/// How many frames ahead each head of a model predicts.
constexpr std::size_t num_heads = intent::num_horizons;
constexpr std::array<std::size_t, num_heads> frames_ahead = [] {
  std::array<std::size_t, num_heads> frames{};
  for (std::size_t head = 0; head < num_heads; ++head) {
    frames[head] =
        static_cast<std::size_t>((intent::horizons[head] + 0.5 * frame_step) / frame_step);
  }
  return frames;
}();

/// Probability of each class, in the order of `intent::Intention`; they sum to 1.
using ClassProbabilities = std::array<double, num_vehicle_classes>;

/// What a model says of one sequence: `at[head][t]` is what it predicts at frame t for frame
/// t + frames_ahead[head].   (num_heads x frames)
struct Forecasts {
  std::array<std::vector<ClassProbabilities>, num_heads> at;
  /// What each probability counts when a class is named (intent::Calibration); 1: the likeliest is.
  std::array<ClassProbabilities, num_heads> naming = [] {
    std::array<ClassProbabilities, num_heads> alike{};
    for (ClassProbabilities& each : alike) {
      each.fill(1.0);
    }
    return alike;
  }();

  /// The class that is named at frame t.
  [[nodiscard]] std::size_t named(std::size_t head, std::size_t t) const {
    return intent::named_class(naming.at(head), at.at(head)[t]);
  }
  /// Likewise at each frame.
  [[nodiscard]] std::vector<std::uint8_t> named(std::size_t head) const;
};

/// Whether all are in [0, 1] and sum to 1, but for the rounding of single precision.
[[nodiscard]] bool is_distribution(const ClassProbabilities& probabilities);

/// The likeliest class; among equals the first.
[[nodiscard]] std::size_t likeliest_class(const ClassProbabilities& probabilities);

/// Visits each frame t of which a head is judged, with the frame that it predicts: both are
/// scored.
/// @param visit  is called with t and that frame
template <class Visit>
void each_judged_frame(const Sequence& sequence, std::size_t head, Visit&& visit) {
  const std::size_t ahead = frames_ahead.at(head);
  for (std::size_t t = 0; t + ahead < sequence.labels.size(); ++t) {
    if (sequence.scored[t] && sequence.scored[t + ahead]) {
      visit(t, t + ahead);
    }
  }
}

/// Throws unless the sequence's parts fit together and its labels are classes of vehicles.
void expect_whole(const Sequence& sequence);
/// Throws unless there is a forecast for each frame by each head, and it is a distribution.
void expect_forecasts_of(const Sequence& sequence, const Forecasts& forecasts);

/// How often what was said of what.
struct Confusion {
  /// [truth][predicted]
  std::array<std::array<std::size_t, num_vehicle_classes>, num_vehicle_classes> counts{};

  /// Of those that are of the class, the share that was found; nullopt: there is none.
  [[nodiscard]] std::optional<double> recall(std::size_t of) const;
  /// Of those that were called so, the share that is; nullopt: none was.
  [[nodiscard]] std::optional<double> precision(std::size_t of) const;
  /// Harmonic mean of both: 0 where all are missed or wrong; nullopt: the class neither occurs nor
  /// is predicted.
  [[nodiscard]] std::optional<double> f1(std::size_t of) const;
  /// Mean F1 over those of the classes that truly occur; nullopt: none does.
  [[nodiscard]] std::optional<double> macro_f1(std::span<const std::size_t> classes) const;
  [[nodiscard]] std::size_t truly(std::size_t of) const;
  [[nodiscard]] std::size_t total() const;
};

/// Classes whose macro F1 is told: what recordings hold, and what simulated vehicles add.
constexpr std::array<std::size_t, 4> recorded_classes{0, 1, 2, 3};  // M, LC, RC, FB
constexpr std::array<std::size_t, 2> simulated_classes{4, 5};       // LB, RB

/// Forecasts of about the same probability.
struct ReliabilityBin {
  std::size_t count = 0;
  double probability = 0.0;  ///< sum of what was predicted
  double right = 0.0;        ///< how many were so
};

/// Bins of equal width over [0, 1], as in Guo et al., On calibration of modern neural networks,
/// ICML 2017.
constexpr std::size_t num_bins = 15;
using Reliability = std::array<ReliabilityBin, num_bins>;

/// Mean over all forecasts of the distance between probability and share of right ones in their
/// bin; nullopt: there is no forecast.
[[nodiscard]] std::optional<double> calibration_error(const Reliability& bins);

/// All that scores are made of, summed over judged frames: tallies of parts add up.
struct Tally {
  Confusion confusion;  ///< of what is named
  Reliability top{};    ///< of the likeliest class
  std::array<Reliability, num_vehicle_classes> of_class{};
  double log_loss = 0.0;  ///< sum of -ln of what the truth was given
  double brier = 0.0;     ///< sum over frames and classes of squared errors

  Tally& operator+=(const Tally& other);

  // Means over the frames; nullopt: there is none.
  /// Expected calibration error of the likeliest class.
  [[nodiscard]] std::optional<double> top_calibration_error() const;
  /// Mean over the classes of the calibration error of "it is this class": Kull et al., Beyond
  /// temperature scaling, NeurIPS 2019.
  [[nodiscard]] std::optional<double> classwise_calibration_error() const;
  [[nodiscard]] std::optional<double> mean_log_loss() const;
  [[nodiscard]] std::optional<double> mean_brier() const;  ///< 0 to 2
};

/// Less than this counts as this in the logarithmic loss: a forecast of 0 would make it infinite.
constexpr double least_probability = 1e-12;

/// The head's forecast at each frame beside the label for which it was made; both frames must be
/// scored, and the second be part of the sequence.
/// @param head  below num_heads
/// @throws ContractViolation  as expect_whole and expect_forecasts_of
[[nodiscard]] Tally tally(const Sequence& sequence, const Forecasts& forecasts, std::size_t head);

/// The sequences' groups, each once, in alphabetic order.
[[nodiscard]] std::vector<std::string> groups_of(std::span<const Sequence> sequences);

/// The tally of each group, in the order of `groups_of`.
/// @param forecasts  one per sequence
[[nodiscard]] std::vector<Tally> group_tallies(std::span<const Sequence> sequences,
                                               std::span<const Forecasts> forecasts,
                                               std::size_t head);

}  // namespace saca::intention_scoring
