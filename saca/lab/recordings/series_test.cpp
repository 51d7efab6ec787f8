#include "saca/lab/recordings/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::recordings::series_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(FilledSeries, DrawsStraightLinesAcrossGapsAndHoldsTheEnds) {
  const FilledSeries result = filled({none, 2.0, none, none, 5.0, none});
  EXPECT_EQ(result.values, (std::vector<double>{2.0, 2.0, 3.0, 4.0, 5.0, 5.0}));
  EXPECT_EQ(result.num_filled, 4U);
  EXPECT_THROW((void)filled({none, none}), ContractViolation);
  EXPECT_THROW((void)filled({}), ContractViolation);
}

TEST(RemoveOutliers, TakesTheSpikeAndLeavesTheSlope) {
  std::vector<double> series;
  for (int k = 0; k < 20; ++k) {
    series.push_back(40.0 - k);  // 10 m/s at 10 Hz
  }
  series[8] = 50.0;
  const double end = series.back();
  EXPECT_EQ(remove_outliers(series, std::vector<double>(20, -10.0), 0.1, 3, 1.5), 1U);
  EXPECT_TRUE(std::isnan(series[8]));
  EXPECT_EQ(series[7], 33.0);
  EXPECT_EQ(series.back(), end);
}

TEST(RemoveOutliers, KnowsMissingValues) {
  std::vector<double> series{none, 1.0, none, 1.1, none};
  EXPECT_EQ(remove_outliers(series, {none, 0.0, none, 0.0, none}, 0.1, 2, 0.5), 0U);
}

TEST(WithoutHolds, KeepsEachNewValueOnce) {
  const std::vector<double> kept = without_holds({5.0, 5.0, 5.0, 4.0, 4.0, 3.0, 3.0, 3.0}, 3);
  ASSERT_EQ(kept.size(), 8U);
  EXPECT_EQ(kept[0], 5.0);
  EXPECT_EQ(kept[3], 4.0);
  EXPECT_EQ(kept[5], 3.0);
  EXPECT_EQ(kept[7], 3.0);  // the last stays: nothing follows
  for (const std::size_t k : {1U, 2U, 4U, 6U}) {
    EXPECT_TRUE(std::isnan(kept[k])) << k;
  }
}

// Ten equal values from a sensor that sends at least every third: the speed was constant until the
// last three.
TEST(WithoutHolds, BelievesALongHold) {
  std::vector<double> series(10, 20.0);
  series.push_back(17.0);
  const std::vector<double> kept = without_holds(series, 3);
  EXPECT_EQ(kept[6], 20.0);
  EXPECT_TRUE(std::isnan(kept[7]));
  EXPECT_TRUE(std::isnan(kept[9]));
  EXPECT_EQ(kept[10], 17.0);
}

TEST(LineFit, IsExactOnALine) {
  std::vector<double> line;
  for (int k = 0; k < 30; ++k) {
    line.push_back(3.0 - 2.0 * 0.1 * k);
  }
  const Fit fit = line_fit(line, 0.1, 5);
  for (std::size_t k = 0; k < line.size(); ++k) {
    EXPECT_NEAR(fit.values[k], line[k], 1e-12);
    EXPECT_NEAR(fit.slopes[k], -2.0, 1e-10);
  }
  EXPECT_EQ(line_fit({4.0}, 0.1, 5).values[0], 4.0);
}

TEST(ParabolaFit, IsExactOnAParabola) {
  std::vector<double> values;
  std::vector<double> slopes;
  for (int k = 0; k < 30; ++k) {
    const double t = 0.1 * k;
    values.push_back(40.0 - 8.0 * t + 2.5 * t * t);
    slopes.push_back(-8.0 + 5.0 * t);
  }
  const Fit fit = parabola_fit(values, slopes, 0.1, 5, 1.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(fit.values[k], values[k], 1e-9);
    EXPECT_NEAR(fit.slopes[k], slopes[k], 1e-9);
  }
}

// Property: with noise of 0.3 m and 0.3 m/s on both, the fit is nearer to the truth than either.
TEST(ParabolaFit, AveragesNoiseAway) {
  std::mt19937 rng(4);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<double> values;
  std::vector<double> slopes;
  for (int k = 0; k < 200; ++k) {
    values.push_back(40.0 - 0.8 * k * 0.1 + noise(rng));
    slopes.push_back(-0.8 + noise(rng));
  }
  const Fit fit = parabola_fit(values, slopes, 0.1, 5, 1.0);
  double square = 0.0;
  for (std::size_t k = 5; k < 195; ++k) {
    square += std::pow(fit.slopes[k] + 0.8, 2);
  }
  EXPECT_LT(std::sqrt(square / 190.0), 0.15);  // eleven slopes alone: 0.3 / sqrt(11) = 0.09
}

TEST(NeverFalling, PoolsWhatFalls) {
  EXPECT_EQ(never_falling({1.0, 2.0, 3.0}), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(never_falling({1.0, 3.0, 2.0, 4.0}), (std::vector<double>{1.0, 2.5, 2.5, 4.0}));
  EXPECT_EQ(never_falling({3.0, 2.0, 1.0}), (std::vector<double>{2.0, 2.0, 2.0}));
  EXPECT_TRUE(never_falling({}).empty());
}

// Properties of the projection: it does not fall, keeps the sum, and is idempotent.
TEST(NeverFalling, IsAProjection) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> value(0.0, 10.0);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> series(40);
    std::generate(series.begin(), series.end(), [&] { return value(rng); });
    const std::vector<double> result = never_falling(series);
    EXPECT_TRUE(std::is_sorted(result.begin(), result.end()));
    EXPECT_NEAR(std::accumulate(result.begin(), result.end(), 0.0),
                std::accumulate(series.begin(), series.end(), 0.0), 1e-9);
    EXPECT_EQ(never_falling(result), result);
  }
}

TEST(Integral, IsTheTrapeziumRule) {
  EXPECT_EQ(integral({2.0, 4.0, 4.0}, 0.5), (std::vector<double>{0.0, 1.5, 3.5}));
}

TEST(Normal3, SolvesAndLeavesTheUndeterminedAtZero) {
  Normal3 full;
  full.add({1.0, 0.0, 1.0}, 4.0, 1.0);
  full.add({0.0, 2.0, 0.0}, 6.0, 3.0);
  full.add({1.0, 1.0, -1.0}, 1.0, 0.5);
  const auto x = full.solution();  // x0 + x2 = 4, x1 = 3, x0 + 3 - x2 = 1
  EXPECT_NEAR(x[0], 1.0, 1e-12);
  EXPECT_NEAR(x[1], 3.0, 1e-12);
  EXPECT_NEAR(x[2], 3.0, 1e-12);
  Normal4 four;  // x0 = 1, x1 = 2, x2 = 3, x3 = 4
  four.add({1.0, 0.0, 0.0, 1.0}, 5.0, 1.0);
  four.add({0.0, 1.0, 1.0, 0.0}, 5.0, 2.0);
  four.add({1.0, 1.0, 0.0, 0.0}, 3.0, 3.0);
  four.add({0.0, 0.0, 1.0, 2.0}, 11.0, 4.0);
  EXPECT_NEAR(four.solution()[0], 1.0, 1e-12);
  EXPECT_NEAR(four.solution()[3], 4.0, 1e-12);
  Normal3 thin;
  thin.add({1.0, 0.0, 0.0}, 5.0, 1.0);
  EXPECT_EQ(thin.solution(), (std::array<double, 3>{5.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace saca::recordings::series_test
