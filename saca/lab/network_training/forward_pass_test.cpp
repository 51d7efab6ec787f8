#include "saca/lab/network_training/forward_pass.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::network_training::forward_pass_test {
namespace {

constexpr std::int64_t sequences = 3;
constexpr std::int64_t frames = 9;
constexpr std::int64_t chains = 2;
constexpr std::int64_t classes = 6;

struct Chains {
  torch::Tensor emissions = torch::randn({sequences, frames, chains, classes});
  torch::Tensor start = torch::randn({chains, classes});
  torch::Tensor transition = torch::randn({chains, classes, classes});
  torch::Tensor present = torch::ones({sequences, frames}, torch::kBool);

  Chains() {
    transition.index_put_({0, 1, 2}, -1e4);  // forbidden
    transition.index_put_({1, 4, 5}, -1e4);
    present[1].narrow(0, frames - 4, 4).fill_(false);
    for (torch::Tensor* each : {&emissions, &start, &transition}) {
      each->set_requires_grad(true);
    }
  }
};

/// The same by libtorch's own operations and derivatives, in double precision.
torch::Tensor frame_by_frame(const Chains& of) {
  const torch::Tensor links = of.transition.to(torch::kFloat64).unsqueeze(0);
  const torch::Tensor emissions = of.emissions.to(torch::kFloat64);
  std::vector<torch::Tensor> scores{of.start.to(torch::kFloat64).unsqueeze(0) +
                                    emissions.select(1, 0)};
  for (std::int64_t t = 1; t < frames; ++t) {
    const torch::Tensor next =
        torch::logsumexp(scores.back().unsqueeze(-1) + links, -2) + emissions.select(1, t);
    scores.push_back(torch::where(of.present.select(1, t).view({-1, 1, 1}), next, scores.back()));
  }
  return torch::stack(scores, 1);
}

TEST(ForwardPass, IsTheSumOverAllPaths) {
  torch::manual_seed(5);
  const Chains of;
  const torch::Tensor scores = forward_pass(of.emissions, of.start, of.transition, of.present);
  EXPECT_TRUE(torch::allclose(scores.to(torch::kFloat64), frame_by_frame(of), 1e-5, 1e-5));
}

TEST(ForwardPass, DerivativesAreThoseOfItsOperations) {
  torch::manual_seed(6);
  const Chains of;
  const torch::Tensor weight = torch::randn({sequences, frames, chains, classes});
  const std::vector<torch::Tensor> inputs{of.emissions, of.start, of.transition};
  const auto ours = torch::autograd::grad(
      {(weight *
        torch::log_softmax(forward_pass(of.emissions, of.start, of.transition, of.present), -1))
           .sum()},
      inputs);
  const auto theirs = torch::autograd::grad(
      {(weight.to(torch::kFloat64) * torch::log_softmax(frame_by_frame(of), -1)).sum()}, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    EXPECT_TRUE(torch::allclose(ours[i], theirs[i], 1e-4, 1e-4)) << i;  // single precision
  }
}

TEST(ForwardPass, WantsShapesThatFit) {
  const Chains of;
  EXPECT_THROW((void)forward_pass(of.emissions, of.start, of.start, of.present), ContractViolation);
  EXPECT_THROW((void)forward_pass(of.emissions, of.transition, of.transition, of.present),
               ContractViolation);
  EXPECT_THROW(
      (void)forward_pass(of.emissions, of.start, of.transition, of.present.narrow(1, 0, 2)),
      ContractViolation);
}

}  // namespace
}  // namespace saca::network_training::forward_pass_test
