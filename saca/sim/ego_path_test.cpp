#include "saca/sim/ego_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/core/contract.h"

namespace saca::sim::ego_path_test {
namespace {

constexpr double step = 0.1;

TEST(EgoPath, FindsTheGyrosBiasOnAStraightRoad) {
  const std::vector<double> speed(120, 15.0);
  const std::vector<double> yaw_rate(120, 0.02);  // all of it bias
  const EgoPath path = ego_path(speed, yaw_rate, step, 100, false);
  EXPECT_NEAR(path.gyro_bias, 0.02, 1e-9);
  for (const world::LanePose& pose : path.poses) {
    EXPECT_NEAR(pose.d, 0.0, 1e-6);
    EXPECT_NEAR(pose.heading, 0.0, 1e-9);
  }
  EXPECT_NEAR(path.poses.back().s, 15.0 * 11.9, 1e-9);
}

// A swerve after the lane was kept: 0.1 rad/s for one second, then back, at 15 m/s: the heading
// peaks at 0.1 rad, the sideways way is v * 0.1 * 1 s = 1.5 m.
TEST(EgoPath, KeepsASwerveThatComesLater) {
  std::vector<double> speed(140, 15.0);
  std::vector<double> yaw_rate(140, -0.01);
  for (std::size_t k = 100; k < 110; ++k) {
    yaw_rate[k] += 0.1;
    yaw_rate[k + 10] -= 0.1;
  }
  const EgoPath path = ego_path(speed, yaw_rate, step, 100, false);
  EXPECT_NEAR(path.gyro_bias, -0.01, 1e-6);
  EXPECT_NEAR(path.poses[139].d, 1.5, 0.03);  // O(step) at the corners of the yaw rate
  EXPECT_NEAR(path.poses[139].heading, 0.0, 1e-4);
}

TEST(EgoPath, FindsTheCurvatureOfACurve) {
  const std::vector<double> speed(120, 10.0);
  const std::vector<double> yaw_rate(120, -0.1);  // radius 100 m to the right
  const EgoPath path = ego_path(speed, yaw_rate, step, 120, true);
  EXPECT_NEAR(path.curvature, -0.01, 1e-5);  // O(step^2) of two ways to integrate
  EXPECT_EQ(path.gyro_bias, 0.0);
  EXPECT_NEAR(path.poses[60].d, 0.0, 1e-2);
}

TEST(EgoPath, LearnsNothingFromAStandingCar) {
  const EgoPath path = ego_path({0.0, 0.0, 1.0}, {0.3, 0.3, 0.3}, step, 3, false);
  EXPECT_EQ(path.gyro_bias, 0.0);
  EXPECT_EQ(path.poses[0].d, 0.0);
}

TEST(EgoPath, RefusesWhatDoesNotFit) {
  EXPECT_THROW((void)ego_path({}, {}, step, 0, false), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {}, step, 0, false), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {0.0}, 0.0, 0, false), ContractViolation);
}

}  // namespace
}  // namespace saca::sim::ego_path_test
