#pragma once

#include <torch/torch.h>

#include <array>

#include "saca/lab/network_training/danger_nets.h"
#include "saca/lab/network_training/danger_samples.h"

namespace saca::network_training {

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

/// What is to be made small over a sample, and what the curve tells of it.
struct Losses {
  torch::Tensor sum;
  DangerProgress told;
};

/// What changes during a training.
struct StepSettings {
  double expectile = 0.99;  ///< of the reversed expectile
  double discount = 1.0;    ///< per look
  double step = 5e-4;       ///< of the optimiser
};

/// What networks say of a sample; but for `v` and `q` without slopes.
struct NetworkValues {
  torch::Tensor v;                 ///< (B), like all
  std::array<torch::Tensor, 2> q;  ///< of what was done
  torch::Tensor slow_q;            ///< of two the larger
  torch::Tensor next_v;
  torch::Tensor next_h;  ///< at x', of the nearest obstacle
};

/// Of one obstacle.
[[nodiscard]] NetworkValues said_by(DangerNets& nets, const TransitionSample& sample);

/// Of two obstacles: what they are by themselves, and what the networks of pairs add.
[[nodiscard]] NetworkValues said_by(DangerNets& pairs, DangerNets& singles,
                                    const TransitionSample& sample);

/// Of V and Q from one another (DangerPlan).
[[nodiscard]] Losses losses_of(const NetworkValues& said, const TransitionSample& sample,
                               const StepSettings& now);

/// Of V from what was reached, wherever the end was seen.
[[nodiscard]] Losses outcome_losses(const NetworkValues& said, const TransitionSample& sample,
                                    const StepSettings& now);

/// Of Q from what V has of x'.
[[nodiscard]] Losses improving_losses(const NetworkValues& said, const TransitionSample& sample,
                                      const StepSettings& now);

/// Of V from the least of what inputs lead to.
[[nodiscard]] Losses fitted_losses(FittedNets& nets, const OutcomeSample& sample,
                                   const StepSettings& now);

}  // namespace saca::network_training
