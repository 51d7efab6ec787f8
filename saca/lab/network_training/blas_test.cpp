#include "saca/lab/network_training/blas.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include <array>
#include <cstddef>

#include "saca/base/core/parallel.h"

namespace saca::network_training::blas_test {
namespace {

// Of OpenBLAS' serial build some of these are wrong, by any amount.
TEST(Blas, ProductsOfTwoThreadsAreThoseOfOne) {
  torch::set_num_threads(1);
  torch::manual_seed(1);
  const torch::Tensor many = torch::rand({128, 96});
  const torch::Tensor few = torch::rand({96, 96});
  const torch::Tensor expected = torch::mm(many, few);
  constexpr int times = 30'000;
  std::array<int, 2> wrong{};
  in_parallel(wrong.size(), 2, [&](std::size_t thread) {
    const torch::NoGradGuard none;
    for (int i = 0; i < times; ++i) {
      wrong[thread] += torch::allclose(torch::mm(many, few), expected) ? 0 : 1;
    }
  });
  EXPECT_EQ(wrong[0] + wrong[1], 0) << "want libopenblas0-pthread as the machine's BLAS";
}

}  // namespace
}  // namespace saca::network_training::blas_test
