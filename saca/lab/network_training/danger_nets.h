#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/net_inputs.h"

namespace saca::network_training {

/// What a network of one obstacle reads of a state, and a Q of an action besides.
constexpr auto num_inputs = static_cast<std::int64_t>(learned_danger::num_net_inputs);
constexpr std::int64_t num_actions = 2;

/// Rectified layers, and what their one output adds to h: at least 0.
class DangerNetImpl : public torch::nn::Module {
 public:
  DangerNetImpl(std::int64_t inputs, std::int64_t width);
  /// @param inputs  (B x inputs)
  /// @param h       (B), [m]
  /// @return        (B), >= h [m]
  torch::Tensor forward(const torch::Tensor& inputs, const torch::Tensor& h);
  /// Without h: (B), >= 0.
  torch::Tensor added(const torch::Tensor& inputs);
  /// Adds its weights as `prefix` + "0.weight", "0.bias", ... "3.bias".
  void add_to(formats::Tensors& tensors, const std::string& prefix) const;
  /// Takes them.
  void take(const formats::Tensors& tensors, const std::string& prefix);

 private:
  torch::nn::Linear first_;
  torch::nn::Linear second_;
  torch::nn::Linear third_;
  torch::nn::Linear last_;
};
TORCH_MODULE(DangerNet);

/// What DangerNetImpl::add_to wrote.
/// @param tensors  has them, as learned_danger::Network checks
[[nodiscard]] DangerNet danger_net(const formats::Tensors& tensors, const std::string& prefix);

/// V_h, and the two Q_h with their slow copies.
class DangerNetsImpl : public torch::nn::Module {
 public:
  /// @param inputs  of V; Q reads the action besides
  DangerNetsImpl(std::int64_t inputs, std::int64_t width);

  DangerNet v;
  DangerNet q1;
  DangerNet q2;
  DangerNet slow_q1;
  DangerNet slow_q2;

  /// Adds what is shipped: `prefix` + "v.0.weight", ..., and both q.
  void add_to(formats::Tensors& tensors, const std::string& prefix) const;
};
TORCH_MODULE(DangerNets);

/// V_h alone, and its slow copy.
class FittedNetsImpl : public torch::nn::Module {
 public:
  explicit FittedNetsImpl(std::int64_t width);

  DangerNet v;
  DangerNet slow_v;
};
TORCH_MODULE(FittedNets);

/// Moves the weights of `slow` by a share of the way to those of `fast`; 1: copies them.
void follow(DangerNet& slow, const DangerNet& fast, double share);

/// What two obstacles look like to the networks of pairs, and what they are by themselves.
struct PairInputs {
  torch::Tensor inputs;  ///< (B x num_pair_inputs)
  torch::Tensor v;       ///< (B), the higher one [m]
  torch::Tensor share;   ///< (B), pair_share
};

/// @param singles  networks of one obstacle
/// @param inputs   (2 B x num_net_inputs), those of a state in sequence
/// @param h_at     (2 B), of each [m]
[[nodiscard]] PairInputs seen_as_pair(DangerNets& singles, const torch::Tensor& inputs,
                                      const torch::Tensor& h_at);

/// V_h beside two obstacles [m].
/// @param inputs  (2 x num_net_inputs)
/// @param h       (2), of each [m]
[[nodiscard]] double joint_value(DangerNets& singles, DangerNets pairs, const torch::Tensor& inputs,
                                 const torch::Tensor& h);

/// V of each [m].
[[nodiscard]] std::vector<double> values_of(DangerNet& v,
                                            std::span<const learned_danger::SeenByNet> seen);

}  // namespace saca::network_training
