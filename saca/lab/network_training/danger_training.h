#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/experience.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/point_mass.h"

namespace saca::network_training {

/// How V_h and Q_h are learnt from a data set alone. All randomness comes from the seed.
///
/// Source: Zheng and co-workers, Safe Offline Reinforcement Learning with Feasibility-Guided
/// Diffusion Model (FISOR), ICLR 2024: V by a reversed expectile, two Q of which the larger is
/// taken, targets that follow slowly (Polyak). Besides, whatever a drive reached bounds its V and Q
/// from above: that is taken as well.
struct DangerPlan {
  std::uint64_t seed = 1;
  int steps = 40'000;
  int batch = 4'096;
  double step = 5e-4;  ///< largest of the optimiser (Adam, falling as a cosine)
  double polyak = 0.005;
  /// Of the reversed expectile, from the first step on and from `annealed` of all steps on: less
  /// than 1 takes a mean between the least and the average of what inputs lead to, too high.
  double expectile_first = 0.9;
  double expectile = 0.99;
  /// Per look of 0.1 s, likewise: less than 1 forgets what is far ahead, too low.
  double discount_first = 0.99;
  double discount = 1.0;
  double annealed = 0.5;
  std::int64_t width = learned_danger::Network::width;  ///< of the three hidden layers
};

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

/// One point of the curve: means since the one before.
struct DangerProgress {
  int step = 0;   ///< so many are done
  int steps = 0;  ///< of so many
  double v_loss = 0.0;
  double q_loss = 0.0;
  double mean_v = 0.0;   ///< [m], of what V is above -farthest_told
  double above = 0.0;    ///< share of states whose V lies 0.2 m or more above what was reached
  double seconds = 0.0;  ///< that it took
};

/// Trains, or goes on where an earlier run of the same plan on the same data was stopped.
/// @param singles   nullptr: the transitions are beside one obstacle; else beside two, and what two
///                  add is learnt: the networks of one stay as they are
/// @param threads   1 or 2: halves of a batch; they do not change the result
/// @param state     file of what is needed to go on; empty: none
/// @param on_point  hears of each point of the curve, also of those of an earlier run; false: stop
/// @return          the networks; Error::Code::malformed, naming the file, if the state is of
///                  another plan, data or networks that are learnt from. When it was stopped they
///                  are as they are then.
[[nodiscard]] Result<DangerNets> trained_danger(
    const learned_danger::Experience& experience, DangerNets* singles, const DangerPlan& plan,
    int threads, const std::filesystem::path& state,
    const std::function<bool(const DangerProgress&)>& on_point);

/// V of driving by the Q whose outcomes these are: what such drives reached is learnt as it is,
/// with no value of its own in it. So V promises nothing that was not driven. Its q are not learnt.
/// @param outcomes  drives by an earlier Q, to their ends
[[nodiscard]] Result<DangerNets> policy_values(
    const learned_danger::Experience& outcomes, DangerNets* singles, const DangerPlan& plan,
    int threads, const std::filesystem::path& state,
    const std::function<bool(const DangerProgress&)>& on_point);

/// Q of what an input leads to and then of what V is of, from transitions of any drivers
/// (learned_danger::keep_held says how long the input is held): the least of it is a step of policy
/// iteration. V stays as it is.
/// @param experience  beside one obstacle
[[nodiscard]] Result<DangerNets> improved_q(
    const learned_danger::Experience& experience, const DangerNet& v, const DangerPlan& plan,
    int threads, const std::filesystem::path& state,
    const std::function<bool(const DangerProgress&)>& on_point);

/// V_h beside two obstacles [m].
/// @param inputs  (2 x num_net_inputs)
/// @param h       (2), of each [m]
[[nodiscard]] double joint_value(DangerNets& singles, DangerNets pairs, const torch::Tensor& inputs,
                                 const torch::Tensor& h);

/// V_h by fitted iteration instead, where it is known what each input leads to: its least over all
/// of them, no expectile, no Q. What is wrong with it is that a network stands for V, and that it
/// is learnt from its own values; nothing comes from what data lack.
/// @param plan  its expectiles are not used
[[nodiscard]] Result<DangerNet> fitted_values(
    const learned_danger::Outcomes& outcomes, const DangerPlan& plan, int threads,
    const std::filesystem::path& state, const std::function<bool(const DangerProgress&)>& on_point);

/// V of each [m].
[[nodiscard]] std::vector<double> values_of(DangerNet& v,
                                            std::span<const learned_danger::SeenByNet> seen);

}  // namespace saca::network_training
