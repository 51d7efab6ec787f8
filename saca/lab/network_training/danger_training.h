#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/experience.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/point_mass.h"
#include "saca/lab/network_training/danger_losses.h"
#include "saca/lab/network_training/danger_nets.h"

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

/// V_h by fitted iteration instead, where it is known what each input leads to: its least over all
/// of them, no expectile, no Q. What is wrong with it is that a network stands for V, and that it
/// is learnt from its own values; nothing comes from what data lack.
/// @param plan  its expectiles are not used
[[nodiscard]] Result<DangerNet> fitted_values(
    const learned_danger::Outcomes& outcomes, const DangerPlan& plan, int threads,
    const std::filesystem::path& state, const std::function<bool(const DangerProgress&)>& on_point);

}  // namespace saca::network_training
