#include "saca/thinking/rollout/concatenated.h"

#include <gtest/gtest.h>

#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::rollout::concatenated_test {
namespace {

// 10 m/s along x until 0.503 s, then 4 m/s along y.
TEST(Joined, IsTheFirstUntilTheSecondStarts) {
  const manoeuvre::EgoMotion before = steady_ego({}, {10.0, 0.0}, 0.0, 2.0);
  manoeuvre::EgoMotion after = steady_ego({{5.03, 0.0}, 0.0}, {0.0, 4.0}, 0.3, 1.0);
  after.track.start = 0.503;
  after.ended = true;
  const manoeuvre::EgoMotion all = concatenated(before, after);
  ASSERT_EQ(all.track.X_WA.size(), 152U);  // to 1.51 s, the first step that reaches 1.503
  ASSERT_EQ(all.v_B.size(), 152U);
  EXPECT_TRUE(all.ended);
  for (std::size_t i = 0; i <= 50; ++i) {
    EXPECT_EQ(all.track.X_WA[i].p.x, before.track.X_WA[i].p.x);
    EXPECT_EQ(all.v_B[i].x, before.v_B[i].x);
  }
  EXPECT_NEAR(all.track.X_WA[51].p.y, 4.0 * (0.51 - 0.503), 1e-9);
  EXPECT_NEAR(all.yaw_rate[51], 0.3, 1e-12);
  EXPECT_NEAR(all.track.X_WA.back().p.y, 4.0, 1e-9);
}

TEST(Joined, ABodyThatStoodUntilItWasStruckStoodThere) {
  const world::Track before{.start = 1.0, .step = 0.1, .X_WA = {{{3.0, 1.0}, 0.2}}};
  world::Track after = steady({{3.0, 1.0}, 0.2}, {2.0, 0.0}, 0.0, 0.5);
  after.start = 4.0;
  const world::Track all = concatenated(before, after);
  EXPECT_EQ(all.step, 0.01);
  EXPECT_NEAR(pose_at(all, 3.9).p.x, 3.0, 1e-12);
  EXPECT_NEAR(pose_at(all, 4.25).p.x, 3.5, 1e-9);
  EXPECT_NEAR(end_time(all), 4.5, 1e-9);
}

}  // namespace
}  // namespace saca::rollout::concatenated_test
