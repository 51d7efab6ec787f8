#include "saca/lab/eval/rate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"

namespace saca::eval::rate_test {
namespace {

/// P(X <= n) of Poisson's law with this mean, term by term.
double at_most(int n, double mean) {
  double term = std::exp(-mean);
  double sum = term;
  for (int k = 1; k <= n; ++k) {
    term *= mean / k;
    sum += term;
  }
  return sum;
}

TEST(PoissonRate, IsGarwoodsTable) {
  // Two-sided 95 % limits for n = 1, 2, 5, 10, 20 as tabulated by Garwood (1936), two decimals.
  struct Line {
    int n;
    double low;
    double high;
  };
  for (const Line& line : {Line{1, 0.025, 5.57}, Line{2, 0.242, 7.22}, Line{5, 1.62, 11.67},
                           Line{10, 4.795, 18.39}, Line{20, 12.22, 30.89}}) {
    const Rate rate = poisson_rate(line.n, 1.0);
    EXPECT_NEAR(rate.low, line.low, 0.005) << line.n;
    EXPECT_NEAR(rate.high, line.high, 0.005) << line.n;
    EXPECT_EQ(rate.value, line.n);
  }
}

TEST(PoissonRate, OfNothingIsBoundedInClosedForm) {
  const Rate rate = poisson_rate(0, 2.0);
  EXPECT_EQ(rate.value, 0.0);
  EXPECT_EQ(rate.low, 0.0);
  EXPECT_NEAR(rate.high, -std::log(0.025) / 2.0, 1e-12);  // 3.689 / 2
}

// The definition: with the rate at a bound, what was counted or more (fewer) has a chance of 2.5 %.
TEST(PoissonRate, CutsOffTailsOf25PerMille) {
  for (const int n : {1, 3, 17, 60}) {
    const Rate rate = poisson_rate(n, 1.0);
    EXPECT_NEAR(at_most(n, rate.high), 0.025, 1e-10);
    EXPECT_NEAR(1.0 - at_most(n - 1, rate.low), 0.025, 1e-10);
  }
}

TEST(PoissonRate, IsPerExposure) {
  const Rate one = poisson_rate(4, 1.0);
  const Rate half = poisson_rate(4, 0.5);
  EXPECT_DOUBLE_EQ(half.value, 2.0 * one.value);
  EXPECT_DOUBLE_EQ(half.low, 2.0 * one.low);
  EXPECT_DOUBLE_EQ(half.high, 2.0 * one.high);
}

TEST(PoissonRate, WantsACountAndAnExposure) {
  EXPECT_THROW((void)poisson_rate(-1, 1.0), ContractViolation);
  for (const double exposure : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)poisson_rate(1, exposure), ContractViolation);
  }
}

}  // namespace
}  // namespace saca::eval::rate_test
