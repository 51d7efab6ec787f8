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

constexpr int curve_step = 500;
constexpr std::size_t num_halves = 2;

StepSettings annealed(const DangerPlan& plan, int step) {
  const double done = static_cast<double>(step) / plan.steps;
  const double share = std::min(1.0, done / plan.annealed);
  const auto towards = [&](double first, double last) { return first + share * (last - first); };
  return {.expectile = towards(plan.expectile_first, plan.expectile),
          .discount = towards(plan.discount_first, plan.discount),
          .step = plan.step * 0.5 * (1.0 + std::cos(std::numbers::pi * done))};
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

using SaidBy = std::function<NetworkValues(DangerNets&, const TransitionSample&)>;

/// @param singles  nullptr: of one obstacle
SaidBy said_of(DangerNets* singles) {
  return [singles](DangerNets& nets, const TransitionSample& sample) {
    return singles == nullptr ? said_by(nets, sample) : said_by(nets, *singles, sample);
  };
}

DangerNets new_nets(const Experience& experience, const DangerPlan& plan) {
  torch::manual_seed(plan.seed);
  const std::size_t inputs = experience.num_obstacles == 1 ? learned_danger::num_net_inputs
                                                           : learned_danger::num_pair_inputs;
  return DangerNets(static_cast<std::int64_t>(inputs), plan.width);
}

/// How a training is run: see `trained_danger`.
struct TrainingRun {
  const DangerPlan& plan;
  int threads;
  const std::filesystem::path& state;
  const std::function<bool(const DangerProgress&)>& on_point;
};

/// What is learnt of the networks, and from what.
struct Teaching {
  std::vector<DangerNet*> learnt;
  SaidBy said;
  std::function<Losses(const NetworkValues&, const TransitionSample&, const StepSettings&)> losses;
  std::string earlier;  ///< digest_of the networks that are learnt from
};

/// Trains some of the networks on what all of them say of a sample.
std::optional<Error> train_on(const Experience& experience, DangerNets& nets,
                              const Teaching& teaching, const TrainingRun& run) {
  const DangerPlan& plan = run.plan;
  Learner learner{.networks = nets.ptr(),
                  .losses =
                      [&](int count, std::mt19937_64& random, const StepSettings& now) {
                        const TransitionSample sample = drawn(experience, count, random);
                        return teaching.losses(teaching.said(nets, sample), sample, now);
                      },
                  .after_step =
                      [&] {
                        follow(nets->slow_q1, nets->q1, plan.polyak);
                        follow(nets->slow_q2, nets->q2, plan.polyak);
                      },
                  .fingerprint = fingerprint_of(plan, experience.size(), experience.num_states(),
                                                experience.reached, teaching.earlier)};
  for (const DangerNet* net : teaching.learnt) {
    const auto some = (*net)->parameters();
    learner.parameters.insert(learner.parameters.end(), some.begin(), some.end());
  }
  return DangerTraining(learner, plan, run.threads, run.state).run(run.on_point);
}

/// What is learnt, and from what.
enum class Lesson {
  v_and_q,      ///< from one another
  v_of_drives,  ///< from what was reached
  q_of_v,
};

/// @param v  not nullptr: to begin with
Result<DangerNets> learnt_from(const Experience& experience, DangerNets* singles,
                               const DangerNet* v, Lesson lesson, const TrainingRun& run) {
  expects(experience.size() > 0 && experience.num_obstacles == (singles == nullptr ? 1U : 2U),
          "transitions beside one obstacle, or two where there are networks of one");
  expects_sound(run.plan);
  DangerNets nets = new_nets(experience, run.plan);
  if (v != nullptr) {
    follow(nets->v, *v, 1.0);
  }
  Teaching teaching{.said = said_of(singles)};
  if (lesson != Lesson::q_of_v) {
    teaching.learnt.push_back(&nets->v);
  }
  if (lesson != Lesson::v_of_drives) {
    teaching.learnt.insert(teaching.learnt.end(), {&nets->q1, &nets->q2});
  }
  teaching.losses = lesson == Lesson::v_and_q       ? losses_of
                    : lesson == Lesson::v_of_drives ? outcome_losses
                                                    : improving_losses;
  teaching.earlier = digest_of(v != nullptr         ? (*v)->parameters()
                               : singles != nullptr ? (*singles)->parameters()
                                                    : std::vector<Tensor>());
  const auto problem = train_on(experience, nets, teaching, run);
  return problem ? Result<DangerNets>(*problem) : nets;
}

}  // namespace

Result<DangerNets> trained_danger(const Experience& experience, DangerNets* singles,
                                  const DangerPlan& plan, int threads,
                                  const std::filesystem::path& state,
                                  const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(experience, singles, nullptr, Lesson::v_and_q,
                     {plan, threads, state, on_point});
}

Result<DangerNets> policy_values(const Experience& outcomes, DangerNets* singles,
                                 const DangerPlan& plan, int threads,
                                 const std::filesystem::path& state,
                                 const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(outcomes, singles, nullptr, Lesson::v_of_drives,
                     {plan, threads, state, on_point});
}

Result<DangerNets> improved_q(const Experience& experience, const DangerNet& v,
                              const DangerPlan& plan, int threads,
                              const std::filesystem::path& state,
                              const std::function<bool(const DangerProgress&)>& on_point) {
  return learnt_from(experience, nullptr, &v, Lesson::q_of_v, {plan, threads, state, on_point});
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

}  // namespace saca::network_training
