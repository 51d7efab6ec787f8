#include "recent_cost.h"

#include <gtest/gtest.h>

namespace saca::model_host::recent_cost_test {
namespace {

TEST(RecentCost, IsTheDearestOfTheLastSteps) {
  RecentCost cost;
  EXPECT_EQ(cost.get(), 0.0);
  cost.add(0.010);
  cost.add(0.030);
  cost.add(0.010);
  EXPECT_GT(cost.get(), 0.010);
  EXPECT_LT(cost.get(), 0.030);
  for (int step = 0; step < 20; ++step) {
    cost.add(0.010);
  }
  EXPECT_EQ(cost.get(), 0.010);
}

// One step took 2 s because the machine stood still. An ask that leaves replies 1 s plans a step
// only where twice its cost fits: without fading none ever would again.
TEST(RecentCost, OfAStepThatStalledIsForgottenFromAskToAsk) {
  RecentCost cost;
  cost.add(0.010);
  cost.add(2.0);
  int asks = 0;
  while (2.0 * cost.get() >= 1.0 && asks < 100) {
    cost.fade();
    ++asks;
  }
  EXPECT_GT(asks, 1) << "but not at once";
  EXPECT_LE(asks, 10);
}

}  // namespace
}  // namespace saca::model_host::recent_cost_test
