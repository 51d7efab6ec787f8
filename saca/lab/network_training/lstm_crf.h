#pragma once

#include <torch/torch.h>

#include <array>
#include <string>

#include "saca/base/formats/tensors.h"
#include "saca/lab/network_training/task.h"
#include "saca/thinking/intent/crf.h"

/// Training of networks with libtorch: optional at build time, never on the product's path.
namespace saca::network_training {

/// How much a label of each class counts.
using ClassWeights = std::array<double, intent::num_classes>;
constexpr ClassWeights all_alike{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/// How the frames of a stream are held together.
enum class Chain : std::uint8_t {
  learnt,  ///< by scores of starts and transitions
  none     ///< not at all: those scores stay 0, each frame is judged by its emissions alone
};

/// The network of intent/network.h with its chains, in a form that can be trained.
class LstmCrfImpl : public torch::nn::Module {
 public:
  explicit LstmCrfImpl(double dropout, Chain chain = Chain::learnt);

  /// Mean emissions of the world and of its mirror image.   (B x T x H x K)
  torch::Tensor emissions(const torch::Tensor& features);

  /// -log p(label | what was seen so far) by the forward pass of the chain, exactly as a stream
  /// tells it; weighted mean over known labels of all horizons. Where a batch is taught, the cross
  /// entropy of what it is taught of a label takes the place of -log p of the label alone.
  /// @param weights  of labels
  torch::Tensor loss(const torch::Tensor& emissions, const Batch& batch,
                     const ClassWeights& weights = all_alike);

  /// Weights under the names of intent/network.h.
  void add_network(formats::Tensors& tensors, const std::string& prefix) const;
  /// Start and transition of all horizons: symmetric in the mirror.   (H x K, H x K x K)
  [[nodiscard]] torch::Tensor start() const;
  [[nodiscard]] torch::Tensor transition() const;

 private:
  torch::nn::Linear input_;
  torch::nn::LSTM lstm_;
  torch::nn::Linear output_;
  torch::nn::Dropout dropout_;
  torch::Tensor start_;
  torch::Tensor transition_;
  torch::Tensor sign_;     ///< of each feature in the mirror
  torch::Tensor swapped_;  ///< class in the mirror
  torch::Tensor mask_;     ///< of forbidden transitions: very negative   (K x K)
};
TORCH_MODULE(LstmCrf);

}  // namespace saca::network_training
