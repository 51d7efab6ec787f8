#pragma once

#include <torch/torch.h>

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/network_training/task.h"
#include "saca/thinking/memory/case.h"

namespace saca::network_training {

/// The network of eval::Imitator in a form that can be trained.
class ImitatorNetImpl : public torch::nn::Module {
 public:
  explicit ImitatorNetImpl(double dropout);

  /// Logarithm of the probability of each policy.   (... x 8)
  /// @param inputs  eval::imitator_inputs   (... x num_imitator_inputs)
  torch::Tensor log_probabilities(const torch::Tensor& inputs);

  /// Mean over the scenes of a batch of -ln of the probability of the policy that was best.
  torch::Tensor loss(const Batch& batch);

  /// The tensors of eval::Imitator.
  [[nodiscard]] formats::Tensors tensors() const;

 private:
  torch::Tensor scores(const torch::Tensor& inputs);

  torch::nn::Linear first_, second_, last_;
  torch::nn::Dropout dropout_;
  torch::Tensor mirror_;    ///< of inputs   (num_imitator_inputs x num_imitator_inputs)
  torch::Tensor policies_;  ///< of each the one in the mirror   (8)
};
TORCH_MODULE(ImitatorNet);

/// Each case as a piece of one frame whose label is the policy that was best in hindsight.
/// @param cases  their scenes break no rule of world::broken_rule
[[nodiscard]] std::vector<Piece> imitator_pieces(std::span<const memory::Case> cases);

/// Trains one, or goes on where an earlier run was stopped (train).
[[nodiscard]] Result<ImitatorNet> trained_imitator(
    const std::vector<Piece>& pieces, const std::vector<Piece>& held_out, const Schedule& schedule,
    double dropout, const std::filesystem::path& state,
    const std::function<bool(const Epoch&)>& on_epoch);

}  // namespace saca::network_training
