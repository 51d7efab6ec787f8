#pragma once

#include <torch/torch.h>

#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/lab/eval/mixture_lstm.h"
#include "saca/lab/eval/place_examples.h"
#include "saca/lab/network_training/task.h"

namespace saca::network_training {

/// The network of eval::MixtureModel in a form that can be trained.
class PlaceMixtureImpl : public torch::nn::Module {
 public:
  explicit PlaceMixtureImpl(double dropout);

  /// Outputs of both sides.   (B x T x 2 x outputs_per_side)
  torch::Tensor outputs(const torch::Tensor& features);

  /// Mean over times, and over frames that are known, of the negative logarithm of the density at
  /// the true place.
  torch::Tensor loss(const Batch& batch);

  /// The tensors of eval::MixtureModel.
  [[nodiscard]] formats::Tensors tensors() const;

 private:
  torch::nn::Linear input_;
  torch::nn::LSTM lstm_;
  torch::nn::Linear output_;
  torch::nn::Dropout dropout_;
  torch::Tensor sign_;  ///< of each feature in the mirror
};
TORCH_MODULE(PlaceMixture);

/// Negative logarithm of the density of the mixture at each place [ln m^2].   (B x T x times)
/// @param outputs  (B x T x 2 x outputs_per_side)
/// @param labels   speed, then s and d at each time, in SI units   (B x T x 1 + 2 times)
[[nodiscard]] torch::Tensor mixture_nll(const torch::Tensor& outputs, const torch::Tensor& labels);

/// Sequences as pieces of at most `longest` frames.
[[nodiscard]] std::vector<Piece> place_pieces(
    const std::vector<std::vector<eval::PlaceExample>>& sequences, std::size_t longest);

/// Trains one, or goes on where an earlier run was stopped (train).
[[nodiscard]] Result<PlaceMixture> trained_mixture(
    const std::vector<Piece>& pieces, const std::vector<Piece>& held_out, const Schedule& schedule,
    double dropout, const std::filesystem::path& state,
    const std::function<bool(const Epoch&)>& on_epoch);

}  // namespace saca::network_training
