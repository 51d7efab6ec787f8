#include "saca/lab/verification/convergence.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::verification::convergence_test {
namespace {

TEST(Refinements, FallAsTheTheoryOfEachSays) {
  const auto all = refinements(3, 1);
  ASSERT_EQ(all.size(), 7U);
  const auto last_order = [&](std::size_t i) { return orders(all[i]).back(); };
  EXPECT_NEAR(last_order(0), 1.0, 0.15);
  EXPECT_NEAR(last_order(1), 2.0, 0.3);
  EXPECT_NEAR(last_order(2), 3.0, 0.4);
  EXPECT_GT(last_order(3), 4.5);
  EXPECT_GT(last_order(4), 2.0);  // what reaches out from the tip's kink, in a band off it
  EXPECT_GT(last_order(5), 2.0);
  EXPECT_GT(last_order(6), 0.9);  // the kink at v = 0 is everywhere
  for (const Refinement& one : all) {
    EXPECT_NEAR(one.spacings[0] / one.spacings[2], 4.0, 1e-9) << one.name;
  }
  EXPECT_THROW((void)refinements(1, 1), ContractViolation);
}

// Halving the spacing divides an error of third order by eight.
TEST(Orders, AreTheSlopesOfTheLogarithms) {
  const auto found = orders({"", {0.4, 0.2, 0.1}, {8e-3, 1e-3, 5e-4}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0], 3.0, 1e-12);
  EXPECT_NEAR(found[1], 1.0, 1e-12);
}

}  // namespace
}  // namespace saca::verification::convergence_test
