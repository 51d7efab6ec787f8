#include "saca/base/world/track.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::world::track_test {
namespace {

const Track track{
    .start = 2.0, .step = 0.5, .X_WA = {{{0.0, 0.0}, 0.0}, {{5.0, 0.0}, 0.2}, {{5.0, 2.0}, 0.2}}};

TEST(Track, InterpolatesBetweenPoses) {
  const Pose X = pose_at(track, 2.25);
  EXPECT_DOUBLE_EQ(X.p.x, 2.5);
  EXPECT_DOUBLE_EQ(X.yaw, 0.1);
  EXPECT_DOUBLE_EQ(velocity_at(track, 2.25).x, 10.0);  // 5 m in half a second
  EXPECT_DOUBLE_EQ(velocity_at(track, 2.75).y, 4.0);
  EXPECT_DOUBLE_EQ(yaw_rate_at(track, 2.25), 0.4);
}

TEST(Track, StandsStillOutside) {
  EXPECT_EQ(end_time(track), 3.0);
  EXPECT_EQ(pose_at(track, 0.0).p.x, 0.0);
  EXPECT_EQ(pose_at(track, 9.0).p.y, 2.0);
  EXPECT_EQ(velocity_at(track, 9.0).y, 0.0);
  EXPECT_EQ(yaw_rate_at(track, 0.0), 0.0);
}

TEST(Track, OnePoseIsABodyAtRest) {
  const Track rest{.X_WA = {{{1.0, 1.0}, 0.3}}};
  EXPECT_EQ(pose_at(rest, 5.0).p.x, 1.0);
  EXPECT_EQ(velocity_at(rest, 0.0).x, 0.0);
}

TEST(SpreadOverTime, IsLinearBetweenAndConstantOutside) {
  const SpreadOverTime spread{.start = 1.0, .step = 0.5, .at = {{1.0, 0.0}, {3.0, 0.2}}};
  EXPECT_DOUBLE_EQ(spread_at(spread, 1.25).along_sd, 2.0);
  EXPECT_DOUBLE_EQ(spread_at(spread, 1.25).across_sd, 0.1);
  EXPECT_EQ(spread_at(spread, 0.0).along_sd, 1.0);
  EXPECT_EQ(spread_at(spread, 9.0).across_sd, 0.2);
  EXPECT_THROW((void)spread_at({}, 0.0), ContractViolation);
}

TEST(Track, RefusesAnEmptyTrackAndNaN) {
  EXPECT_THROW((void)pose_at({}, 0.0), ContractViolation);
  EXPECT_THROW((void)pose_at(track, std::nan("")), ContractViolation);
}

}  // namespace
}  // namespace saca::world::track_test
