#include "saca/base/core/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include <algorithm>
#include <numeric>

namespace saca::parallel_test {
namespace {

TEST(InParallel, DoesEachOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 7}) {
    std::vector<int> done(1000);
    in_parallel(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 1000) << threads;
    EXPECT_EQ(*std::max_element(done.begin(), done.end()), 1) << threads;
  }
}

TEST(InParallel, NothingToDoIsDone) {
  in_parallel(0, 3, [](std::size_t) { FAIL(); });
}

TEST(Parallel, WhatIsThrownIsThrownAgain) {
  for (const int threads : {1, 3}) {
    EXPECT_THROW(in_parallel(100, threads,
                             [](std::size_t i) {
                               if (i == 17) {
                                 throw std::runtime_error("seventeen");
                               }
                             }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace saca::parallel_test
