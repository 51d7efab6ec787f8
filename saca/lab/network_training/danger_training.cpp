#include "saca/lab/network_training/danger_training.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/network_training/task.h"

namespace saca::network_training {
namespace {

using learned_danger::Experience;
using torch::Tensor;

constexpr auto num_inputs = static_cast<std::int64_t>(learned_danger::num_net_inputs);
constexpr std::int64_t num_actions = 2;
constexpr int curve_step = 500;
constexpr std::size_t num_halves = 2;

/// Transitions side by side beside K obstacles, some seen in a mirror.
struct Sample {
  Tensor inputs;  ///< (B K x inputs), those of a transition in sequence
  Tensor next_inputs;
  Tensor actions;  ///< (B x 2)
  Tensor h_at;     ///< (B K)
  Tensor next_h_at;
  Tensor h;  ///< (B), like all that follow
  Tensor settled;
  Tensor reached;
};

/// -1 where a mirror changes the sign.
std::vector<float> signs_of_inputs() {
  std::vector<float> signs(learned_danger::num_net_inputs, 1.0F);
  for (const std::size_t i : learned_danger::mirrored_inputs()) {
    signs[i] = -1.0F;
  }
  return signs;
}

/// A row of numbers that the networks see.
void copy_inputs(const std::vector<float>& rows, std::size_t row, bool is_mirrored, float* to) {
  static const std::vector<float> signs = signs_of_inputs();
  const float* const numbers = &rows[row * learned_danger::num_net_inputs];
  for (std::size_t j = 0; j < learned_danger::num_net_inputs; ++j) {
    to[j] = is_mirrored ? signs[j] * numbers[j] : numbers[j];
  }
}

/// Any transitions, each second one seen in a mirror.
Sample drawn(const Experience& all, int count, std::mt19937_64& random) {
  const auto n = static_cast<std::int64_t>(count);
  const auto rows = n * static_cast<std::int64_t>(all.num_obstacles);
  Sample sample{.inputs = torch::empty({rows, num_inputs}),
                .next_inputs = torch::empty({rows, num_inputs}),
                .actions = torch::empty({n, num_actions}),
                .h_at = torch::empty({rows}),
                .next_h_at = torch::empty({rows}),
                .h = torch::empty({n}),
                .settled = torch::empty({n}),
                .reached = torch::empty({n})};
  const auto at = [](Tensor& tensor) { return tensor.data_ptr<float>(); };
  std::uniform_int_distribution<std::size_t> any(0, all.size() - 1);
  std::int64_t to = 0;
  for (std::int64_t k = 0; k < n; ++k) {
    const std::size_t i = any(random);
    const bool is_mirrored = k % 2 == 1;
    std::size_t from = all.row[i] * all.num_obstacles;
    std::size_t next = all.next_row[i] * all.num_obstacles;
    for (std::size_t one = 0; one < all.num_obstacles; ++one, ++from, ++next, ++to) {
      copy_inputs(all.inputs, from, is_mirrored, at(sample.inputs) + to * num_inputs);
      copy_inputs(all.inputs, next, is_mirrored, at(sample.next_inputs) + to * num_inputs);
      at(sample.h_at)[to] = all.h_at[from];
      at(sample.next_h_at)[to] = all.h_at[next];
    }
    at(sample.actions)[2 * k] = all.actions[2 * i];
    at(sample.actions)[2 * k + 1] = (is_mirrored ? -1.0F : 1.0F) * all.actions[2 * i + 1];
    at(sample.h)[k] = all.h[i];
    at(sample.settled)[k] = all.settled[i];
    at(sample.reached)[k] = all.reached[i];
  }
  return sample;
}

/// States side by side, and what A inputs lead to.
struct SampleOfOutcomes {
  Tensor inputs;       ///< (B x inputs)
  Tensor h_at;         ///< (B)
  Tensor next_inputs;  ///< (B A x inputs)
  Tensor next_h_at;    ///< (B A), like all that follow
  Tensor h;
  Tensor settled;
};

/// Any states, each second one seen in a mirror.
SampleOfOutcomes drawn(const learned_danger::Outcomes& all, int count, std::mt19937_64& random) {
  const auto n = static_cast<std::int64_t>(count);
  const auto num_outcomes = n * static_cast<std::int64_t>(all.num_inputs);
  SampleOfOutcomes sample{.inputs = torch::empty({n, num_inputs}),
                          .h_at = torch::empty({n}),
                          .next_inputs = torch::empty({num_outcomes, num_inputs}),
                          .next_h_at = torch::empty({num_outcomes}),
                          .h = torch::empty({num_outcomes}),
                          .settled = torch::empty({num_outcomes})};
  const auto at = [](Tensor& tensor) { return tensor.data_ptr<float>(); };
  std::uniform_int_distribution<std::size_t> any(0, all.num_states() - 1);
  std::int64_t to = 0;
  for (std::int64_t k = 0; k < n; ++k) {
    const std::size_t row = any(random);
    const bool is_mirrored = k % 2 == 1;
    copy_inputs(all.states, row, is_mirrored, at(sample.inputs) + k * num_inputs);
    at(sample.h_at)[k] = all.h_at[row];
    for (std::size_t i = row * all.num_inputs; i < (row + 1) * all.num_inputs; ++i, ++to) {
      copy_inputs(all.next_states, i, is_mirrored, at(sample.next_inputs) + to * num_inputs);
      at(sample.next_h_at)[to] = all.next_h[i];
      at(sample.h)[to] = all.h[i];
      at(sample.settled)[to] = all.settled[i];
    }
  }
  return sample;
}

/// What is to be made small over a sample, and what the curve tells of it.
struct Losses {
  Tensor sum;
  DangerProgress told;
};

/// What changes during a training.
struct StepSettings {
  double expectile;
  double discount;
  double step;
};

StepSettings annealed(const DangerPlan& plan, int step) {
  const double done = static_cast<double>(step) / plan.steps;
  const double share = std::min(1.0, done / plan.annealed);
  const auto towards = [&](double first, double last) { return first + share * (last - first); };
  return {.expectile = towards(plan.expectile_first, plan.expectile),
          .discount = towards(plan.discount_first, plan.discount),
          .step = plan.step * 0.5 * (1.0 + std::cos(std::numbers::pi * done))};
}

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

/// What networks say of a sample; but for `v` and `q` without slopes.
struct NetworkValues {
  Tensor v;                 ///< (B), like all
  std::array<Tensor, 2> q;  ///< of what was done
  Tensor slow_q;            ///< of two the larger
  Tensor next_v;
  Tensor next_h;  ///< at x', of the nearest obstacle
};

/// Of both Q from what they are to be.
Tensor q_loss(const NetworkValues& said, const Tensor& target, const Tensor& weight) {
  const auto of = [&](const Tensor& q) { return (weight * squared(q - target)).mean(); };
  return of(said.q[0]) + of(said.q[1]);
}

/// What the curve tells of V.
DangerProgress told_of_v(const NetworkValues& said, const Sample& sample) {
  const torch::NoGradGuard none;
  return {.mean_v = mean_that_matters(said.v),
          .above = (said.v > sample.reached + 0.2).to(torch::kFloat32).mean().item<double>()};
}

Losses losses_of(const NetworkValues& said, const Sample& sample, const StepSettings& now) {
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

/// Of one obstacle.
NetworkValues said_by(DangerNets& nets, const Sample& sample) {
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

/// What two obstacles look like to the networks of pairs, and what they are by themselves.
struct PairInputs {
  Tensor inputs;  ///< (B x num_pair_inputs)
  Tensor v;       ///< (B), the higher one [m]
  Tensor share;   ///< (B), pair_share
};

PairInputs seen_as_pair(DangerNets& singles, const Tensor& inputs, const Tensor& h_at) {
  const torch::NoGradGuard none;
  const Tensor both = singles->v(inputs, h_at).view({-1, 2});
  const Tensor first_is_other = both.select(1, 0) < both.select(1, 1);
  const Tensor rows = inputs.view({-1, 2, num_inputs});
  const Tensor swapped = torch::where(first_is_other.view({-1, 1, 1}), rows.flip(1), rows);
  const Tensor higher = std::get<0>(both.max(1));
  const Tensor lower = std::get<0>(both.min(1));
  const Tensor scaled = learned_danger::pair_value_scale * torch::stack({higher, lower}, 1);
  return {.inputs = torch::cat({swapped.reshape({-1, 2 * num_inputs}), scaled}, 1),
          .v = higher,
          .share = (learned_danger::pair_share_slope * (lower - learned_danger::pair_counts_from))
                       .clamp(0.0, 1.0)};
}

/// Of two obstacles: what they are by themselves, and what the networks of pairs add.
NetworkValues said_by(DangerNets& pairs, DangerNets& singles, const Sample& sample) {
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

Losses fitted_losses(FittedNets& nets, const SampleOfOutcomes& sample, const StepSettings& now) {
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

void follow(DangerNet& slow, DangerNet& fast, double share) {
  const torch::NoGradGuard none;
  const auto to = slow->parameters();
  const auto from = fast->parameters();
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i].lerp_(from[i], share);
  }
}

/// Of networks that others are learnt from; empty: there are none.
std::string digest_of(const std::vector<Tensor>& weights) {
  Fnv hash;
  for (const Tensor& each : weights) {
    const Tensor numbers = each.detach().contiguous();
    const float* const first = numbers.data_ptr<float>();
    for (std::int64_t i = 0; i < numbers.numel(); ++i) {
      hash.add(std::bit_cast<std::uint32_t>(first[i]));
    }
  }
  return weights.empty() ? "" : fmt::format("{:016x}", hash.value());
}

/// @param earlier  digest_of the networks that are learnt from
std::string fingerprint_of(const DangerPlan& plan, std::size_t transitions, std::size_t states,
                           const std::vector<float>& some, const std::string& earlier) {
  Fnv hash;
  hash.add(earlier);
  hash.add(fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", plan.seed, plan.steps, plan.batch,
                       plan.step, plan.polyak, plan.expectile_first, plan.expectile,
                       plan.discount_first, plan.discount, plan.annealed, plan.width, transitions,
                       states));
  for (std::size_t i = 0; i < some.size(); i += 1'009) {
    hash.add(fmt::format("{}", some[i]));
  }
  return fmt::format("{:016x}", hash.value());
}

void expects_sound(const DangerPlan& plan) {
  expects(plan.steps > 0 && plan.batch >= static_cast<int>(num_halves) && plan.width > 0,
          "steps, a batch and a width > 0");
}

/// What is trained.
struct Learner {
  std::shared_ptr<torch::nn::Module> networks;  ///< those that only follow included
  std::vector<Tensor> parameters;               ///< of those that are learnt
  std::function<Losses(int count, std::mt19937_64& random, const StepSettings& now)> losses;
  std::function<void()> after_step;
  std::string fingerprint;  ///< of plan, data and the networks that are learnt from
};

class DangerTraining {
 public:
  DangerTraining(Learner learner, const DangerPlan& plan, int threads, std::filesystem::path state)
      : learner_(std::move(learner)),
        plan_(plan),
        threads_(threads),
        state_{std::move(state), learner_.fingerprint},
        optimiser_(learner_.parameters, torch::optim::AdamOptions(plan.step)) {}

  std::optional<Error> run(const std::function<bool(const DangerProgress&)>& on_point) {
    if (auto problem = resume()) {
      return problem;
    }
    for (const DangerProgress& point : curve_) {
      if (!on_point(point)) {
        return std::nullopt;
      }
    }
    while (done_ < plan_.steps) {
      curve_.push_back(next_point());
      if (auto problem = keep()) {
        return problem;
      }
      if (!on_point(curve_.back())) {
        break;
      }
    }
    return std::nullopt;
  }

 private:
  DangerProgress next_point() {
    const auto begin = std::chrono::steady_clock::now();
    const int last = std::min(plan_.steps, done_ + curve_step);
    const double share = 1.0 / (last - done_);
    DangerProgress point;
    for (; done_ < last; ++done_) {
      const DangerProgress one = one_step();
      point.v_loss += share * one.v_loss;
      point.q_loss += share * one.q_loss;
      point.mean_v += share * one.mean_v;
      point.above += share * one.above;
    }
    point.step = done_;
    point.steps = plan_.steps;
    point.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return point;
  }

  /// The halves of a batch by themselves: their gradients are added in a fixed order.
  DangerProgress one_step() {
    const StepSettings now = annealed(plan_, done_);
    for (auto& group : optimiser_.param_groups()) {
      static_cast<torch::optim::AdamOptions&>(group.options()).lr(now.step);
    }
    std::array<std::vector<Tensor>, num_halves> gradients;
    std::array<DangerProgress, num_halves> told;
    in_parallel(num_halves, threads_, [&](std::size_t half) {
      std::seed_seq words{plan_.seed, static_cast<std::uint64_t>(done_),
                          static_cast<std::uint64_t>(half)};
      std::mt19937_64 random(words);
      const Losses losses =
          learner_.losses(plan_.batch / static_cast<int>(num_halves), random, now);
      gradients[half] = torch::autograd::grad({losses.sum}, learner_.parameters);
      told[half] = losses.told;
    });
    for (std::size_t i = 0; i < learner_.parameters.size(); ++i) {
      learner_.parameters[i].mutable_grad() = 0.5 * (gradients[0][i] + gradients[1][i]);
    }
    constexpr double gradient_limit = 10.0;
    torch::nn::utils::clip_grad_norm_(learner_.parameters, gradient_limit);
    optimiser_.step();
    learner_.after_step();
    return {.v_loss = 0.5 * (told[0].v_loss + told[1].v_loss),
            .q_loss = 0.5 * (told[0].q_loss + told[1].q_loss),
            .mean_v = 0.5 * (told[0].mean_v + told[1].mean_v),
            .above = 0.5 * (told[0].above + told[1].above)};
  }

  std::optional<Error> keep() {
    Tensor curve = torch::empty({static_cast<std::int64_t>(curve_.size()), 6}, torch::kFloat64);
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      const DangerProgress& point = curve_[i];
      const auto row = curve[static_cast<std::int64_t>(i)];
      row[0] = point.step;
      row[1] = point.v_loss;
      row[2] = point.q_loss;
      row[3] = point.mean_v;
      row[4] = point.above;
      row[5] = point.seconds;
    }
    return network_training::keep(state_, *learner_.networks, optimiser_, curve);
  }

  std::optional<Error> resume() {
    const auto kept = network_training::resume(state_, *learner_.networks, optimiser_);
    if (!kept.has_value()) {
      return kept.error();
    }
    if (!kept.value()) {
      return std::nullopt;
    }
    const Tensor& curve = *kept.value();
    for (std::int64_t i = 0; i < curve.size(0); ++i) {
      const auto number = [&](std::int64_t k) { return curve[i][k].item<double>(); };
      curve_.push_back({.step = static_cast<int>(number(0)),
                        .steps = plan_.steps,
                        .v_loss = number(1),
                        .q_loss = number(2),
                        .mean_v = number(3),
                        .above = number(4),
                        .seconds = number(5)});
    }
    done_ = curve_.empty() ? 0 : curve_.back().step;
    return std::nullopt;
  }

  Learner learner_;
  const DangerPlan& plan_;
  int threads_;
  TrainingState state_;
  torch::optim::Adam optimiser_;
  std::vector<DangerProgress> curve_;
  int done_ = 0;  ///< steps
};

}  // namespace

DangerNetImpl::DangerNetImpl(std::int64_t inputs, std::int64_t width)
    : first_(inputs, width), second_(width, width), third_(width, width), last_(width, 1) {
  register_module("first", first_);
  register_module("second", second_);
  register_module("third", third_);
  register_module("last", last_);
}

Tensor DangerNetImpl::added(const Tensor& inputs) {
  Tensor x = torch::relu(first_(inputs));
  x = torch::relu(second_(x));
  x = torch::relu(third_(x));
  return torch::softplus(last_(x).squeeze(1));
}

Tensor DangerNetImpl::forward(const Tensor& inputs, const Tensor& h) {
  return h + added(inputs);
}

void DangerNetImpl::add_to(formats::Tensors& tensors, const std::string& prefix) const {
  int number = 0;
  for (const auto* layer : {&first_, &second_, &third_, &last_}) {
    const std::string name = prefix + std::to_string(number++);
    tensors.tensors[name + ".weight"] = plain((*layer)->weight);
    tensors.tensors[name + ".bias"] = plain((*layer)->bias);
  }
}

void DangerNetImpl::take(const formats::Tensors& tensors, const std::string& prefix) {
  const torch::NoGradGuard none;
  int number = 0;
  const auto copy = [&](const Tensor& to, const std::string& name) {
    const std::vector<float>& from = tensors.tensors.at(name).values;
    expects(static_cast<std::int64_t>(from.size()) == to.numel(), "weights of that size");
    std::copy(from.begin(), from.end(), to.data_ptr<float>());
  };
  for (const auto* layer : {&first_, &second_, &third_, &last_}) {
    const std::string name = prefix + std::to_string(number++);
    copy((*layer)->weight, name + ".weight");
    copy((*layer)->bias, name + ".bias");
  }
}

DangerNet danger_net(const formats::Tensors& tensors, const std::string& prefix) {
  const formats::Tensor& first = tensors.tensors.at(prefix + "0.weight");
  DangerNet net(static_cast<std::int64_t>(first.shape.at(1)),
                static_cast<std::int64_t>(first.shape.at(0)));
  net->take(tensors, prefix);
  return net;
}

DangerNetsImpl::DangerNetsImpl(std::int64_t inputs, std::int64_t width)
    : v(inputs, width),
      q1(inputs + num_actions, width),
      q2(inputs + num_actions, width),
      slow_q1(inputs + num_actions, width),
      slow_q2(inputs + num_actions, width) {
  register_module("v", v);
  register_module("q1", q1);
  register_module("q2", q2);
  register_module("slow_q1", slow_q1);
  register_module("slow_q2", slow_q2);
  follow(slow_q1, q1, 1.0);
  follow(slow_q2, q2, 1.0);
}

FittedNetsImpl::FittedNetsImpl(std::int64_t width)
    : v(num_inputs, width), slow_v(num_inputs, width) {
  register_module("v", v);
  register_module("slow_v", slow_v);
  follow(slow_v, v, 1.0);
}

void DangerNetsImpl::add_to(formats::Tensors& tensors, const std::string& prefix) const {
  v->add_to(tensors, prefix + "v.");
  q1->add_to(tensors, prefix + "q1.");
  q2->add_to(tensors, prefix + "q2.");
}

namespace {

using SaidBy = std::function<NetworkValues(DangerNets&, const Sample&)>;

/// @param singles  nullptr: of one obstacle
SaidBy said_of(DangerNets* singles) {
  return [singles](DangerNets& nets, const Sample& sample) {
    return singles == nullptr ? said_by(nets, sample) : said_by(nets, *singles, sample);
  };
}

DangerNets new_nets(const Experience& experience, const DangerPlan& plan) {
  torch::manual_seed(plan.seed);
  const std::size_t inputs = experience.num_obstacles == 1 ? learned_danger::num_net_inputs
                                                           : learned_danger::num_pair_inputs;
  return DangerNets(static_cast<std::int64_t>(inputs), plan.width);
}

/// Trains some of the networks on what all of them say of a sample.
/// @param earlier  digest_of the networks that are learnt from
std::optional<Error> train_on(
    const Experience& experience, DangerNets& nets, const std::vector<DangerNet*>& learnt,
    const DangerPlan& plan, int threads, const std::filesystem::path& state,
    const std::string& earlier, const SaidBy& said,
    const std::function<Losses(const NetworkValues&, const Sample&, const StepSettings&)>& losses,
    const std::function<bool(const DangerProgress&)>& on_point) {
  Learner learner{.networks = nets.ptr(),
                  .losses =
                      [&](int count, std::mt19937_64& random, const StepSettings& now) {
                        const Sample sample = drawn(experience, count, random);
                        return losses(said(nets, sample), sample, now);
                      },
                  .after_step =
                      [&] {
                        follow(nets->slow_q1, nets->q1, plan.polyak);
                        follow(nets->slow_q2, nets->q2, plan.polyak);
                      },
                  .fingerprint = fingerprint_of(plan, experience.size(), experience.num_states(),
                                                experience.reached, earlier)};
  for (const DangerNet* net : learnt) {
    const auto some = (*net)->parameters();
    learner.parameters.insert(learner.parameters.end(), some.begin(), some.end());
  }
  return DangerTraining(learner, plan, threads, state).run(on_point);
}

/// Of V from what was reached, wherever the end was seen.
Losses outcome_losses(const NetworkValues& said, const Sample& sample,
                      const StepSettings& /*now*/) {
  const Tensor is_seen = torch::isfinite(sample.reached);
  const Tensor off = torch::where(is_seen, said.v - sample.reached, torch::zeros_like(said.v));
  const Tensor loss = (weight_of(said.v.detach()) * squared(off)).mean();
  DangerProgress told = told_of_v(said, sample);
  told.v_loss = loss.item<double>();
  return {loss, told};
}

/// Of Q from what V has of x'.
Losses improving_losses(const NetworkValues& said, const Sample& sample,
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

/// What is learnt, and from what.
enum class Lesson {
  v_and_q,      ///< from one another
  v_of_drives,  ///< from what was reached
  q_of_v,
};

/// @param v  not nullptr: to begin with
Result<DangerNets> learnt_from(const Experience& experience, DangerNets* singles,
                               const DangerNet* v, Lesson lesson, const DangerPlan& plan,
                               int threads, const std::filesystem::path& state,
                               const std::function<bool(const DangerProgress&)>& on_point) {
  expects(experience.size() > 0 && experience.num_obstacles == (singles == nullptr ? 1U : 2U),
          "transitions beside one obstacle, or two where there are networks of one");
  expects_sound(plan);
  DangerNets nets = new_nets(experience, plan);
  if (v != nullptr) {
    DangerNet earlier = *v;
    follow(nets->v, earlier, 1.0);
  }
  std::vector<DangerNet*> learnt;
  if (lesson != Lesson::q_of_v) {
    learnt.push_back(&nets->v);
  }
  if (lesson != Lesson::v_of_drives) {
    learnt.insert(learnt.end(), {&nets->q1, &nets->q2});
  }
  const auto losses = lesson == Lesson::v_and_q       ? losses_of
                      : lesson == Lesson::v_of_drives ? outcome_losses
                                                      : improving_losses;
  const std::string earlier = digest_of(v != nullptr         ? (*v)->parameters()
                                        : singles != nullptr ? (*singles)->parameters()
                                                             : std::vector<Tensor>());
  const auto problem = train_on(experience, nets, learnt, plan, threads, state, earlier,
                                said_of(singles), losses, on_point);
  return problem ? Result<DangerNets>(*problem) : nets;
}

}  // namespace

Result<DangerNets> trained_danger(const Experience& experience, DangerNets* singles,
                                  const DangerPlan& plan, int threads,
                                  const std::filesystem::path& state,
                                  const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(experience, singles, nullptr, Lesson::v_and_q, plan, threads, state, on_point);
}

Result<DangerNets> policy_values(const Experience& outcomes, DangerNets* singles,
                                 const DangerPlan& plan, int threads,
                                 const std::filesystem::path& state,
                                 const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(outcomes, singles, nullptr, Lesson::v_of_drives, plan, threads, state,
                     on_point);
}

Result<DangerNets> improved_q(const Experience& experience, const DangerNet& v,
                              const DangerPlan& plan, int threads,
                              const std::filesystem::path& state,
                              const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(experience, nullptr, &v, Lesson::q_of_v, plan, threads, state, on_point);
}

double joint_value(DangerNets& singles, DangerNets pairs, const Tensor& inputs, const Tensor& h) {
  const torch::NoGradGuard none;
  const PairInputs seen = seen_as_pair(singles, inputs, h);
  return (seen.v + seen.share * pairs->v->added(seen.inputs)).item<double>();
}

Result<DangerNet> fitted_values(const learned_danger::Outcomes& outcomes, const DangerPlan& plan,
                                int threads, const std::filesystem::path& state,
                                const std::function<bool(const DangerProgress&)>& on_point) {
  expects(outcomes.num_states() > 0, "something to learn from");
  expects_sound(plan);
  torch::manual_seed(plan.seed);
  FittedNets nets(plan.width);
  const Learner learner{.networks = nets.ptr(),
                        .parameters = nets->v->parameters(),
                        .losses =
                            [&](int count, std::mt19937_64& random, const StepSettings& now) {
                              return fitted_losses(nets, drawn(outcomes, count, random), now);
                            },
                        .after_step = [&] { follow(nets->slow_v, nets->v, plan.polyak); },
                        .fingerprint = fingerprint_of(plan, outcomes.h.size(),
                                                      outcomes.num_states(), outcomes.h_at, "")};
  if (const auto problem = DangerTraining(learner, plan, threads, state).run(on_point)) {
    return *problem;
  }
  return nets->v;
}

std::vector<double> values_of(DangerNet& v, std::span<const learned_danger::SeenByNet> seen) {
  const auto n = static_cast<std::int64_t>(seen.size());
  Tensor inputs = torch::empty({n, num_inputs});
  Tensor h = torch::empty({n});
  for (std::int64_t i = 0; i < n; ++i) {
    const learned_danger::SeenByNet& one = seen[static_cast<std::size_t>(i)];
    std::copy(one.inputs.begin(), one.inputs.end(), inputs.data_ptr<float>() + i * num_inputs);
    h.data_ptr<float>()[i] = static_cast<float>(learned_danger::told(one.h));
  }
  const torch::NoGradGuard none;
  const Tensor values = v(inputs, h).contiguous();
  return {values.data_ptr<float>(), values.data_ptr<float>() + n};
}

}  // namespace saca::network_training
