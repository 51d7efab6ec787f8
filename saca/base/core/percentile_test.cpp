#include "saca/base/core/percentile.h"

#include <gtest/gtest.h>

namespace saca::percentile_test {
namespace {

// The textbook's example of nearest rank: 15, 20, 35, 40, 50.
TEST(Percentile, IsTheNearestRank) {
  const std::vector<double> values{40.0, 15.0, 50.0, 35.0, 20.0};
  EXPECT_EQ(percentile(values, 0.0), 15.0);
  EXPECT_EQ(percentile(values, 0.05), 15.0);
  EXPECT_EQ(percentile(values, 0.30), 20.0);
  EXPECT_EQ(percentile(values, 0.40), 20.0);
  EXPECT_EQ(percentile(values, 0.50), 35.0);
  EXPECT_EQ(percentile(values, 1.0), 50.0);
}

TEST(Percentile, OfNothingIsRefused) {
  EXPECT_THROW((void)percentile({}, 0.5), ContractViolation);
  EXPECT_THROW((void)percentile({1.0}, 1.1), ContractViolation);
}

}  // namespace
}  // namespace saca::percentile_test
