#include "saca/base/core/pose.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saca::pose_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Pose, MovesAPointFromBodyToWorld) {
  const Pose X_WB{{10.0, 5.0}, pi / 2.0};  // facing north
  const Vec2 p_W = X_WB * Vec2{2.0, 1.0};  // two ahead, one to the left
  EXPECT_NEAR(p_W.x, 9.0, 1e-12);
  EXPECT_NEAR(p_W.y, 7.0, 1e-12);
}

TEST(Pose, InverseUndoesIt) {
  const Pose X_WB{{-3.0, 7.0}, 2.5};
  const Pose identity = inverse(X_WB) * X_WB;
  EXPECT_NEAR(norm(identity.p), 0.0, 1e-12);
  EXPECT_NEAR(identity.yaw, 0.0, 1e-12);
}

TEST(Pose, ComposesLikeTwoMoves) {
  const Pose X_WL{{1.0, 2.0}, 0.4};
  const Pose X_LB{{5.0, -1.0}, 3.0};
  const Vec2 p_B{0.3, 0.7};
  const Vec2 once = (X_WL * X_LB) * p_B;
  const Vec2 twice = X_WL * (X_LB * p_B);
  EXPECT_NEAR(norm(once - twice), 0.0, 1e-12);
}

TEST(Pose, InterpolatesYawAcrossTheSeam) {
  const Pose middle = between({{0.0, 0.0}, pi - 0.1}, {{2.0, 0.0}, -pi + 0.1}, 0.5);
  EXPECT_NEAR(middle.p.x, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(middle.yaw), pi, 1e-12);
}

}  // namespace
}  // namespace saca::pose_test
