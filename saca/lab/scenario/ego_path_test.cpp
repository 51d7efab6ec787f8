#include "saca/lab/scenario/ego_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::scenario::ego_path_test {
namespace {

constexpr double step = 0.1;

/// Nearly nothing is believed before.
constexpr double open_minded = 1.0;

/// Slows down from 20 to 8 m/s and speeds up again: only then bias and curvature differ.
std::vector<double> uneven_speed(std::size_t size) {
  std::vector<double> speed;
  for (std::size_t k = 0; k < size; ++k) {
    speed.push_back(14.0 + 6.0 * std::cos(0.05 * static_cast<double>(k)));
  }
  return speed;
}

/// What a gyro with that bias measures on an arc.
std::vector<double> on_arc(const std::vector<double>& speed, double curvature, double bias) {
  std::vector<double> yaw_rate;
  for (const double v : speed) {
    yaw_rate.push_back(curvature * v + bias);
  }
  return yaw_rate;
}

TEST(EgoPath, FindsTheGyrosBiasOnAStraightRoad) {
  const std::vector<double> speed(120, 15.0);
  const std::vector<double> yaw_rate(120, 0.02);  // all of it bias
  const EgoPath path =
      ego_path(speed, yaw_rate, step,
               {.num_keeping = 100, .bias = 0.0, .bias_sd = open_minded, .curvature_sd = 1e-6});
  EXPECT_NEAR(path.gyro_bias, 0.02, 1e-4);
  EXPECT_NEAR(path.curvature, 0.0, 1e-5);
  EXPECT_NEAR(path.keeping_rms, 0.0, 0.01);
  for (const world::LanePose& pose : path.poses) {
    EXPECT_NEAR(pose.d, 0.0, 0.02);
    EXPECT_NEAR(pose.heading, 0.0, 1e-3);
  }
  EXPECT_NEAR(path.poses.back().s, 15.0 * 11.9, 1e-9);
}

// Yaw rate = curvature * speed + bias, so both are known where the speed changes.
TEST(EgoPath, TellsCurvatureAndBiasApartWhereTheSpeedChanges) {
  const std::vector<double> speed = uneven_speed(140);
  const EgoPath path =
      ego_path(speed, on_arc(speed, 0.004, -0.01), step,
               {.num_keeping = 120, .bias_sd = open_minded, .curvature_sd = open_minded});
  EXPECT_NEAR(path.curvature, 0.004, 2e-5);  // O(step^2) of two ways to integrate
  EXPECT_NEAR(path.gyro_bias, -0.01, 3e-4);
  for (const world::LanePose& pose : path.poses) {
    EXPECT_NEAR(pose.d, 0.0, 0.03);
  }
}

// At one speed v only bias + curvature * v is seen: it is divided as the variances are.
TEST(EgoPath, DividesWhatItCannotTellApartAsItWasBelieved) {
  const std::vector<double> speed(120, 10.0);
  const EgoPath path = ego_path(speed, std::vector<double>(120, 0.05), step,
                                {.num_keeping = 120, .bias_sd = 0.02, .curvature_sd = 0.004});
  EXPECT_NEAR(path.gyro_bias + 10.0 * path.curvature, 0.05, 1e-4);
  // Variances of the yaw rate: 0.02^2 by the bias, (10 * 0.004)^2 by the curvature.
  EXPECT_NEAR(path.gyro_bias, 0.05 * 0.2, 1e-4);
  EXPECT_NEAR(path.poses.back().d, 0.0, 0.02);
}

// A swerve after the lane was kept: 0.1 rad/s for one second, then back, at 15 m/s: the heading
// peaks at 0.1 rad, the sideways way is v * 0.1 * 1 s = 1.5 m.
TEST(EgoPath, KeepsASwerveThatComesLater) {
  const std::vector<double> speed(140, 15.0);
  std::vector<double> yaw_rate(140, -0.01);
  for (std::size_t k = 100; k < 110; ++k) {
    yaw_rate[k] += 0.1;
    yaw_rate[k + 10] -= 0.1;
  }
  const EgoPath path =
      ego_path(speed, yaw_rate, step, {.num_keeping = 100, .bias = -0.01, .bias_sd = 0.001});
  EXPECT_NEAR(path.gyro_bias, -0.01, 1e-5);
  EXPECT_NEAR(path.poses[139].d, 1.5, 0.03);  // O(step) at the corners of the yaw rate
  EXPECT_NEAR(path.poses[139].heading, 0.0, 1e-3);
}

// A swerve and back again, 3 s of the 12 s in which the lane is kept: up to 0.1 rad within 1 s,
// down to -0.1 rad within the next, and to 0. The lane lies where the car was for most of the time.
TEST(EgoPath, AShortSwerveDoesNotBendTheLane) {
  const std::vector<double> speed(160, 15.0);
  std::vector<double> yaw_rate(160, 0.0);
  for (std::size_t k = 40; k < 50; ++k) {
    yaw_rate[k] += 0.1;
    yaw_rate[k + 10] -= 0.2;
    yaw_rate[k + 20] += 0.1;
  }
  const EgoPath path = ego_path(speed, yaw_rate, step, {.num_keeping = 120});
  EXPECT_NEAR(path.poses[0].d, 0.0, 0.25);
  EXPECT_NEAR(path.poses[119].d, 0.0, 0.25);
  EXPECT_NEAR(path.poses[55].d - path.poses[39].d, 15.0 * (0.05 + 0.025), 0.1);  // at its farthest
}

TEST(EgoPath, OfTheMirroredDriveIsMirrored) {
  const std::vector<double> speed = uneven_speed(140);
  std::vector<double> yaw_rate = on_arc(speed, 0.003, 0.004);
  for (std::size_t k = 60; k < 64; ++k) {
    yaw_rate[k] += 0.07;
  }
  std::vector<double> mirrored;
  for (const double rate : yaw_rate) {
    mirrored.push_back(-rate);
  }
  const EgoPath left = ego_path(speed, yaw_rate, step, {.num_keeping = 120, .bias = 0.002});
  const EgoPath right = ego_path(speed, mirrored, step, {.num_keeping = 120, .bias = -0.002});
  EXPECT_DOUBLE_EQ(left.curvature, -right.curvature);
  EXPECT_DOUBLE_EQ(left.gyro_bias, -right.gyro_bias);
  for (std::size_t k = 0; k < speed.size(); ++k) {
    EXPECT_NEAR(left.poses[k].d, -right.poses[k].d, 1e-9);
    EXPECT_NEAR(left.poses[k].heading, -right.poses[k].heading, 1e-9);
  }
}

TEST(EgoPath, LearnsNothingFromAStandingCar) {
  const EgoPath path =
      ego_path({0.0, 0.0, 0.0}, {0.3, 0.3, 0.3}, step, {.num_keeping = 3, .bias = 0.01});
  EXPECT_NEAR(path.gyro_bias, 0.01, 1e-12);
  EXPECT_EQ(path.curvature, 0.0);
  EXPECT_EQ(path.poses[2].d, 0.0);
}

TEST(EgoPath, RefusesWhatDoesNotFit) {
  EXPECT_THROW((void)ego_path({}, {}, step, {}), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {}, step, {}), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {0.0}, 0.0, {}), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {0.0}, step, {.num_keeping = 2}), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {0.0}, step, {.bias_sd = 0.0}), ContractViolation);
  EXPECT_THROW((void)ego_path({1.0}, {0.0}, step, {.curvature_sd = std::nan("")}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::scenario::ego_path_test
