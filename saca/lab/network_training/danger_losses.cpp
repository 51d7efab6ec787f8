#include "saca/lab/network_training/danger_losses.h"

#include <tuple>

#include "saca/lab/learned_danger/network.h"

namespace saca::network_training {
namespace {

using torch::Tensor;

/// How much a state counts: what is near the boundary the most. By V alone, so that no input is
/// preferred to another.
Tensor weight_of(const Tensor& v) {
  constexpr double near = 3.0;  // [m]
  const Tensor share = v / near;
  return 0.05 + 1.0 / (1.0 + share * share);
}

/// Of what V is above -farthest_told [m].
double mean_that_matters(const Tensor& v) {
  const Tensor matters = (v > -learned_danger::farthest_told + 0.1).to(torch::kFloat32);
  return ((v * matters).sum() / matters.sum().clamp_min(1.0)).item<double>();
}

/// Of a difference [m]: its square, beyond 2 m as its size. A few far ones would else tear the
/// networks away.
Tensor squared(const Tensor& off) {
  constexpr double linear_from = 2.0;  // [m]
  const Tensor size = off.abs();
  return torch::where(size < linear_from, off * off, linear_from * (2.0 * size - linear_from));
}

/// Of both Q from what they are to be.
Tensor q_loss(const NetworkValues& said, const Tensor& target, const Tensor& weight) {
  const auto of = [&](const Tensor& q) { return (weight * squared(q - target)).mean(); };
  return of(said.q[0]) + of(said.q[1]);
}

/// What the curve tells of V.
DangerProgress told_of_v(const NetworkValues& said, const TransitionSample& sample) {
  const torch::NoGradGuard none;
  return {.mean_v = mean_that_matters(said.v),
          .above = (said.v > sample.reached + 0.2).to(torch::kFloat32).mean().item<double>()};
}

}  // namespace

Losses losses_of(const NetworkValues& said, const TransitionSample& sample,
                 const StepSettings& now) {
  Tensor target_q;
  Tensor slow_q;
  {
    const torch::NoGradGuard none;
    const Tensor ahead = torch::where(sample.settled > 0.5, said.next_h, said.next_v);
    const Tensor undiscounted = torch::maximum(sample.h, ahead);
    target_q = torch::minimum(sample.reached, sample.h + now.discount * (undiscounted - sample.h));
    slow_q = torch::minimum(sample.reached, said.slow_q);
  }
  const Tensor& v = said.v;
  const Tensor weight = weight_of(v.detach());
  const Tensor over = slow_q - v;  // of Q above V
  const Tensor side = torch::where(over < 0.0, torch::full_like(over, now.expectile),
                                   torch::full_like(over, 1.0 - now.expectile));
  const Tensor of_v = (weight * side * squared(over)).mean();
  const Tensor of_q = q_loss(said, target_q, weight);
  DangerProgress told = told_of_v(said, sample);
  told.v_loss = of_v.item<double>();
  told.q_loss = of_q.item<double>();
  return {of_v + of_q, told};
}

NetworkValues said_by(DangerNets& nets, const TransitionSample& sample) {
  const Tensor with_action = torch::cat({sample.inputs, sample.actions}, 1);
  NetworkValues said{.v = nets->v(sample.inputs, sample.h_at),
                     .q = {nets->q1(with_action, sample.h_at), nets->q2(with_action, sample.h_at)},
                     .next_h = sample.next_h_at};
  const torch::NoGradGuard none;
  said.slow_q = torch::maximum(nets->slow_q1(with_action, sample.h_at),
                               nets->slow_q2(with_action, sample.h_at));
  said.next_v = nets->v(sample.next_inputs, sample.next_h_at);
  return said;
}

NetworkValues said_by(DangerNets& pairs, DangerNets& singles, const TransitionSample& sample) {
  const PairInputs now = seen_as_pair(singles, sample.inputs, sample.h_at);
  const Tensor with_action = torch::cat({now.inputs, sample.actions}, 1);
  Tensor single_q;
  NetworkValues said;
  {
    const torch::NoGradGuard none;
    const Tensor each = torch::cat({sample.inputs, sample.actions.repeat_interleave(2, 0)}, 1);
    const Tensor q = torch::maximum(singles->q1(each, sample.h_at), singles->q2(each, sample.h_at));
    single_q = std::get<0>(q.view({-1, 2}).max(1));
    said.next_h = std::get<0>(sample.next_h_at.view({-1, 2}).max(1));
    const PairInputs next = seen_as_pair(singles, sample.next_inputs, sample.next_h_at);
    said.next_v = next.v + next.share * pairs->v->added(next.inputs);
    said.slow_q = single_q + now.share * torch::maximum(pairs->slow_q1->added(with_action),
                                                        pairs->slow_q2->added(with_action));
  }
  said.v = now.v + now.share * pairs->v->added(now.inputs);
  said.q = {single_q + now.share * pairs->q1->added(with_action),
            single_q + now.share * pairs->q2->added(with_action)};
  return said;
}

Losses fitted_losses(FittedNets& nets, const OutcomeSample& sample, const StepSettings& now) {
  Tensor target;
  {
    const torch::NoGradGuard none;
    const Tensor ahead = torch::where(sample.settled > 0.5, sample.next_h_at,
                                      nets->slow_v(sample.next_inputs, sample.next_h_at));
    const Tensor undiscounted = torch::maximum(sample.h, ahead);
    const Tensor of_each = sample.h + now.discount * (undiscounted - sample.h);
    target = std::get<0>(of_each.view({sample.h_at.size(0), -1}).min(1));
  }
  const Tensor v = nets->v(sample.inputs, sample.h_at);
  const Tensor loss = (weight_of(v.detach()) * squared(v - target)).mean();
  const torch::NoGradGuard none;
  return {loss, {.v_loss = loss.item<double>(), .mean_v = mean_that_matters(v)}};
}

Losses outcome_losses(const NetworkValues& said, const TransitionSample& sample,
                      const StepSettings& /*now*/) {
  const Tensor is_seen = torch::isfinite(sample.reached);
  const Tensor off = torch::where(is_seen, said.v - sample.reached, torch::zeros_like(said.v));
  const Tensor loss = (weight_of(said.v.detach()) * squared(off)).mean();
  DangerProgress told = told_of_v(said, sample);
  told.v_loss = loss.item<double>();
  return {loss, told};
}

Losses improving_losses(const NetworkValues& said, const TransitionSample& sample,
                        const StepSettings& /*now*/) {
  Tensor target;
  {
    const torch::NoGradGuard none;
    target = torch::maximum(sample.h, torch::where(sample.settled > 0.5, said.next_h, said.next_v));
  }
  const Tensor loss = q_loss(said, target, weight_of(said.v.detach()));
  DangerProgress told = told_of_v(said, sample);
  told.q_loss = loss.item<double>();
  return {loss, told};
}

}  // namespace saca::network_training
