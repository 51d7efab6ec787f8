#include "saca/lab/intention_scoring/bootstrap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::intention_scoring::bootstrap_test {
namespace {

GroupFigure mean_of(const std::vector<double>& values) {
  return [&values](std::span<const std::size_t> groups) -> std::optional<double> {
    double sum = 0.0;
    for (const std::size_t group : groups) {
      sum += values[group];
    }
    return sum / static_cast<double>(groups.size());
  };
}

std::vector<double> normal_draws(std::size_t count) {
  std::mt19937_64 rng(3);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(normal(rng));
  }
  return values;
}

TEST(Bootstrap, OfAMeanIsItsStandardError) {
  const auto values = normal_draws(200);
  double mean = 0.0;
  double square = 0.0;
  for (const double value : values) {
    mean += value / 200.0;
    square += value * value / 200.0;
  }
  const double error = std::sqrt((square - mean * mean) / 200.0);
  const auto interval = bootstrap(200, mean_of(values), 2000, 1);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->value, mean, 1e-12);
  // The quantile of 2,000 draws has a standard error of about 6 % of the distance.
  EXPECT_NEAR(interval->low, mean - 1.96 * error, 0.2 * error);
  EXPECT_NEAR(interval->high, mean + 1.96 * error, 0.2 * error);
  EXPECT_EQ(interval->draws, 2000U);
}

TEST(Bootstrap, SameSeedDrawsTheSame) {
  const auto values = normal_draws(30);
  const auto a = bootstrap(30, mean_of(values), 100, 5);
  const auto b = bootstrap(30, mean_of(values), 100, 5);
  const auto c = bootstrap(30, mean_of(values), 100, 6);
  EXPECT_EQ(a->low, b->low);
  EXPECT_EQ(a->high, b->high);
  EXPECT_NE(a->low, c->low);
}

TEST(Bootstrap, OfADifferenceIsPaired) {
  // Two models that differ by 0.1 in each group differ by 0.1 in each draw, however groups vary.
  const auto values = normal_draws(40);
  const auto interval = bootstrap(
      40,
      [&](std::span<const std::size_t> groups) -> std::optional<double> {
        double better = 0.0;
        double worse = 0.0;
        for (const std::size_t group : groups) {
          better += values[group] + 0.1;
          worse += values[group];
        }
        return (better - worse) / static_cast<double>(groups.size());
      },
      200, 1);
  EXPECT_NEAR(interval->low, 0.1, 1e-12);
  EXPECT_NEAR(interval->high, 0.1, 1e-12);
}

TEST(Bootstrap, OfOneGroupHasNoWidth) {
  const std::vector<double> one{4.0};
  const auto interval = bootstrap(1, mean_of(one), 10, 1);
  EXPECT_EQ(interval->low, 4.0);
  EXPECT_EQ(interval->high, 4.0);
}

TEST(Bootstrap, DrawsWithoutTheFigureAreLeftOut) {
  // Only group 0 has something to say: of three groups it is missed by (2/3)^3 = 30 % of draws.
  const GroupFigure figure = [](std::span<const std::size_t> groups) -> std::optional<double> {
    const std::set<std::size_t> drawn(groups.begin(), groups.end());
    return drawn.contains(0) ? std::optional<double>(1.0) : std::nullopt;
  };
  const auto interval = bootstrap(3, figure, 1000, 1);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(static_cast<double>(interval->draws), 1000.0 * (1.0 - 8.0 / 27.0), 60.0);
  const GroupFigure never = [](std::span<const std::size_t> /*groups*/) {
    return std::optional<double>();
  };
  EXPECT_EQ(bootstrap(3, never, 10, 1), std::nullopt);
}

TEST(Bootstrap, RefusesNoGroupsAndNoDraws) {
  const std::vector<double> one{4.0};
  EXPECT_THROW((void)bootstrap(0, mean_of(one), 10, 1), ContractViolation);
  EXPECT_THROW((void)bootstrap(1, mean_of(one), 0, 1), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::bootstrap_test
