#include "saca/onboard/collision/outcome.h"

#include <gtest/gtest.h>

namespace saca::collision::outcome_test {
namespace {

// What `judge` finds is tested where it is found: rollout/judge_test.cpp.

TEST(EndOfMotion, IsAtRestBelowFiveCentimetresPerSecondInAnyDirection) {
  manoeuvre::EgoMotion motion{.track = {.X_WA = {Pose{}, Pose{}}},
                              .v_B = {{10.0, 0.0}, {0.04, 0.0}},
                              .yaw_rate = {0.0, 0.0}};
  EXPECT_FALSE(moves_at_end(motion));
  motion.v_B.back() = {0.04, -0.04};
  EXPECT_TRUE(moves_at_end(motion));
  motion.v_B.back() = {-0.06, 0.0};
  EXPECT_TRUE(moves_at_end(motion));
}

}  // namespace
}  // namespace saca::collision::outcome_test
