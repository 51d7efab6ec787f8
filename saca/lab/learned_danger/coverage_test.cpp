#include "saca/lab/learned_danger/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/exact.h"
#include "saca/lab/learned_danger/table_for_test.h"

namespace saca::learned_danger::coverage_test {
namespace {

const SquareAtRest& solved() {
  static const SquareAtRest one;
  return one;
}

/// Drives of one look each, at 8 to 9 m/s towards the square from where it can just be avoided or
/// not; what is done is the best demand, `off` along it from there.
Transitions drives(int count, double off) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> speed(8.0, 9.0);
  std::uniform_real_distribution<double> ahead(4.5, 6.5);
  std::uniform_real_distribution<double> left(-0.5, 0.5);
  Transitions all;
  for (int i = 0; i < count; ++i) {
    State state{.ego = {.v_B = {speed(random), 0.0}}, .grip = 0.9};
    state.obstacles.push_back(
        {.body = solved().square, .X_WO = {{ahead(random), left(random)}, 0.0}});
    const auto best =
        exact_best(solved().model, solved().limits, solved().ego, state, state.obstacles[0]);
    all.add({.observation = observation(state),
             .demand = {best.value().along + off, best.value().across},
             .is_cut_off = true});
    ++all.drives;
  }
  return all;
}

CoverageSurvey survey() {
  return {solved().limits, solved().ego, solved().model, 20, 400};
}

// The best demands of states this much alike are mostly the same.
TEST(Coverage, IsAsFarAsWhatWasDoneIsFromTheBest) {
  CoverageSurvey best = survey();
  best.add(drives(600, 0.0));
  const auto with_best = best.figures(2);
  ASSERT_EQ(with_best.size(), 1U) << "one bin of speed and grip";
  EXPECT_EQ(with_best[0].slowest, 0.0);
  EXPECT_EQ(with_best[0].fastest, 10.0);
  EXPECT_NEAR(with_best[0].least_grip, 0.8, 1e-12);
  EXPECT_EQ(with_best[0].states, 20U);
  EXPECT_GE(with_best[0].others, 32U);
  EXPECT_LT(with_best[0].median, 0.1);

  CoverageSurvey away = survey();
  away.add(drives(600, 3.0));
  EXPECT_GT(away.figures(1)[0].median, 1.0) << "nobody did anything like it";
}

TEST(Coverage, IsNothingWithoutStatesNearTheBoundary) {
  CoverageSurvey none = survey();
  State far{.ego = {.v_B = {5.0, 0.0}}, .grip = 0.9};
  far.obstacles.push_back({.body = solved().square, .X_WO = {{35.0, 0.0}, 0.0}});
  Transitions part;
  part.add({.observation = observation(far)});
  none.add(part);
  EXPECT_TRUE(none.figures(1).empty());
  EXPECT_FALSE(none.is_full());
}

TEST(Coverage, WantsEnoughToAskAmong) {
  EXPECT_THROW(CoverageSurvey(solved().limits, solved().ego, solved().model, 0, 400),
               ContractViolation);
  EXPECT_THROW(CoverageSurvey(solved().limits, solved().ego, solved().model, 10, 31),
               ContractViolation);
}

}  // namespace
}  // namespace saca::learned_danger::coverage_test
