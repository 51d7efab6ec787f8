#pragma once

#include <torch/torch.h>

#include <random>

#include "saca/lab/learned_danger/experience.h"
#include "saca/lab/learned_danger/point_mass.h"

namespace saca::network_training {

/// Transitions side by side beside K obstacles, some seen in a mirror.
struct TransitionSample {
  torch::Tensor inputs;  ///< (B K x inputs), those of a transition in sequence
  torch::Tensor next_inputs;
  torch::Tensor actions;  ///< (B x 2)
  torch::Tensor h_at;     ///< (B K)
  torch::Tensor next_h_at;
  torch::Tensor h;  ///< (B), like all that follow
  torch::Tensor settled;
  torch::Tensor reached;
};

/// States side by side, and what A inputs lead to.
struct OutcomeSample {
  torch::Tensor inputs;       ///< (B x inputs)
  torch::Tensor h_at;         ///< (B)
  torch::Tensor next_inputs;  ///< (B A x inputs)
  torch::Tensor next_h_at;    ///< (B A), like all that follow
  torch::Tensor h;
  torch::Tensor settled;
};

/// Any transitions, each second one seen in a mirror.
/// @param count  of them, > 0
[[nodiscard]] TransitionSample drawn(const learned_danger::Experience& all, int count,
                                     std::mt19937_64& random);

/// Any states likewise.
[[nodiscard]] OutcomeSample drawn(const learned_danger::Outcomes& all, int count,
                                  std::mt19937_64& random);

}  // namespace saca::network_training
