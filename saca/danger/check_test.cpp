#include "saca/danger/check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saca::danger::check_test {
namespace {

Checked one(double told, double acted, double best) {
  return {.speed = 10.0, .grip = 0.9, .told = told, .acted = acted, .best = best};
}

// Six situations that can be counted by hand.
TEST(CheckFigures, AreSharesOfWhatTheySay) {
  const std::vector<Checked> all{one(-1.0, -1.2, -1.2),  // told safe, is
                                 one(-0.5, 0.1, -0.1),   // told safe, evaded by others, hit by Q
                                 one(-0.2, 0.4, 0.4),    // told safe, hit by all
                                 one(0.5, 0.6, 0.6),     // told unsafe, is
                                 one(0.3, -0.7, -0.7),   // false alarm
                                 one(-15.0, -30.0, -30.0)};  // far
  const CheckFigures figures = figures_of(all, 0.0);
  EXPECT_EQ(figures.hit_given_told_safe.count, 2);
  EXPECT_EQ(figures.hit_given_told_safe.of, 4);
  EXPECT_EQ(figures.told_safe_given_hit.count, 1);
  EXPECT_EQ(figures.told_safe_given_hit.of, 2);
  EXPECT_EQ(figures.false_alarms.count, 1);
  EXPECT_EQ(figures.false_alarms.of, 4);
  EXPECT_EQ(figures.agreeing_near.of, 5);
  EXPECT_EQ(figures.agreeing_near.count, 3);
  EXPECT_NEAR(figures.mean_error_near, (0.2 + 0.4 + 0.6 + 0.1 + 1.0) / 5.0, 1e-12);
  EXPECT_NEAR(figures.bias_near, (0.2 - 0.4 - 0.6 - 0.1 + 1.0) / 5.0, 1e-12);
  EXPECT_NEAR(figures.p99_error_near, 1.0, 1e-12);
  EXPECT_NEAR(figures.lost_near, 0.2 / 5.0, 1e-12);

  const CheckFigures careful = figures_of(all, 0.6);
  EXPECT_EQ(careful.hit_given_told_safe.count, 0);
  EXPECT_EQ(careful.hit_given_told_safe.of, 2);
  EXPECT_EQ(careful.false_alarms.count, 2);
  EXPECT_EQ(figures_of({}, 0.0).hit_given_told_safe.value(), 0.0);
}

// The chance of at most k hits in n at the bound is what is left of the confidence.
TEST(CheckFigures, BoundIsExactForSharesThatWereCounted) {
  EXPECT_NEAR(upper_bound({0, 13'809}, 1.0 - 1e-6), 1e-3, 1e-6) << "1 - (1e-6)^(1/n)";
  EXPECT_NEAR(upper_bound({5, 10}, 0.95), 0.7776, 1e-4) << "Clopper and Pearson's table";
  EXPECT_EQ(upper_bound({10, 10}, 0.95), 1.0);
  EXPECT_EQ(upper_bound({0, 0}, 0.95), 1.0);
}

// With a margin just above the worst hit nothing that is told safe hits.
TEST(CheckMargin, LeavesNoHitThatItHasSeen) {
  std::vector<Checked> all;
  for (int i = 0; i < 100; ++i) {
    const double told = -0.1 * i;
    all.push_back(one(told, i % 7 == 3 && i < 40 ? 0.2 : -1.0, -1.0));
  }
  const double margin = margin_of(all);
  EXPECT_NEAR(margin, 3.8, 0.02) << "the safest that was told of a hit: i = 38";
  EXPECT_EQ(figures_of(all, margin).hit_given_told_safe.count, 0);
  EXPECT_GT(figures_of(all, margin - 0.05).hit_given_told_safe.count, 0);
  EXPECT_EQ(margin_of({one(-1.0, -1.0, -1.0)}), 0.0);
}

}  // namespace
}  // namespace saca::danger::check_test
