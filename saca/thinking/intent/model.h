#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/thinking/intent/crf.h"
#include "saca/thinking/intent/network.h"

namespace saca::intent {

/// May a vehicle go from one class to the other within look_step? To the other side it goes by M or
/// FB only: expert knowledge of the paper's kind (LB -> RB is forbidden, and its like).
[[nodiscard]] constexpr bool may_follow(std::size_t from, std::size_t to) {
  constexpr std::array<int, num_classes> side{0, 1, -1, 0, 1, -1};
  return side[from] * side[to] >= 0;
}

/// How the probabilities of one horizon are made honest, and which of them is named.
///
///   p'(k) ~ p(k)^inverse_temperature exp(bias(k))
///
/// Classes that count more in training are told too often by the network: bias takes that back.
/// Sources: Guo et al., On calibration of modern neural networks, ICML 2017 (temperature and vector
/// scaling); Lipton, Elkan, Naryanaswamy, Optimal thresholding of classifiers to maximize F1
/// measure, ECML 2014 (F1 is greatest where a class is named from a probability of half that F1 on,
/// not from 0.5 on).
struct Calibration {
  double inverse_temperature = 1.0;  ///< > 0
  Scores bias{};                     ///< of logarithms
  /// What each probability counts when the class is named; > 0.
  Scores naming{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
};

/// Honest probabilities, which sum to 1.
[[nodiscard]] Scores calibrated(const Calibration& calibration, const Scores& probabilities);

/// The class of the greatest product of naming and honest probability; among equals the first.
[[nodiscard]] std::size_t named_class(const Scores& naming, const Scores& probabilities);

/// What was learnt about vehicles: an LSTM-CRF for each horizon, with common LSTMs.
///
/// Several networks are asked, and their emissions averaged: they were trained from different
/// seeds.
struct Model {
  static constexpr std::size_t max_networks = 4;

  std::vector<Network> networks;  ///< at most max_networks; empty: nothing was learnt, and
                                  ///< everybody is taken to go on as they do, whoever walks too
  std::array<Crf, num_horizons> chains;  ///< structurally masked by may_follow
  std::array<Calibration, num_horizons> calibrations;
};

/// From the tensors of training: "networks" (how many), "K.input.weight" and so on for network K
/// from 0 on (network.h), "chain.start" (num_horizons x num_classes), "chain.transition"
/// (num_horizons x num_classes x num_classes, from x to; what is forbidden is not looked at),
/// and of the calibrations "sharpness" (num_horizons: the inverse temperature), "bias" and "naming"
/// (num_horizons x num_classes).
/// @return  Error::Code::malformed, naming source, tensor, wanted and got
[[nodiscard]] Result<Model> model_from(const formats::Tensors& tensors, std::string_view source);

/// @return  as read_file and model_from
[[nodiscard]] Result<Model> read_model(const std::filesystem::path& path);

/// Names the weights: models that differ in a bit have different digests.
[[nodiscard]] std::uint64_t digest(const Model& model);

/// Probabilities of the classes, one array per horizon; each sums to 1.
using HorizonScores = std::array<Scores, num_horizons>;

/// One vehicle as it is watched: what is remembered of it. Fixed in size, copyable; allocates
/// nothing.
class Stream {
 public:
  /// One look, look_step after the last one.
  /// @return  what the vehicle does or is about to do, given all that was seen so far
  HorizonScores step(const Model& model, const Observation& observation);

 private:
  ObservationHistory history_;
  std::array<Network::State, Model::max_networks> states_{};
  std::array<CrfFilter, num_horizons> filters_{};
};

}  // namespace saca::intent
