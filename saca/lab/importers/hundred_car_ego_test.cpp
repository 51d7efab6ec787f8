#include "saca/lab/importers/hundred_car_ego.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::importers::hundred_car_ego_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Rows = std::vector<recordings::HundredCarRow>;

/// On an arc of that curvature, with that bias of the gyro; the speed changes between 8 and 20 m/s.
Rows rows_on_arc(double curvature, double bias) {
  Rows rows(200);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].speed = 14.0 + 6.0 * std::cos(0.05 * static_cast<double>(k));
    rows[k].yaw_rate = curvature * rows[k].speed + bias;
  }
  return rows;
}

TEST(GyroBelief, IsTheYawRateOfAStandingCar) {
  Rows rows = rows_on_arc(0.01, 0.02);
  for (std::size_t k = 100; k < 140; ++k) {
    rows[k].speed = 0.0;
    rows[k].yaw_rate = 0.02;
  }
  rows[102].yaw_rate = 0.3;  // it still turns: its speed is held
  rows[120].yaw_rate = nan;
  const GyroBelief belief = gyro_belief(rows, true);
  EXPECT_NEAR(belief.bias, 0.02, 1e-12);
  EXPECT_NEAR(to_degrees(belief.sd), 0.1, 1e-12);
}

TEST(GyroBelief, IsTheMedianOnAStraightRoadAndNothingOnACurve) {
  Rows rows = rows_on_arc(0.0, 0.01);
  rows[30].yaw_rate = 1.0;  // a jolt
  EXPECT_NEAR(gyro_belief(rows, false).bias, 0.01, 1e-12);
  EXPECT_EQ(gyro_belief(rows, true).bias, 0.0);
  EXPECT_GT(gyro_belief(rows, true).sd, gyro_belief(rows, false).sd);
  // 0.05 rad/s = 2.9 deg/s is no bias.
  EXPECT_EQ(gyro_belief(rows_on_arc(0.0, 0.05), false).bias, 0.0);
  EXPECT_EQ(gyro_belief({}, false).bias, 0.0);
  EXPECT_EQ(gyro_belief(Rows(50, {.speed = nan, .yaw_rate = nan}), false).bias, 0.0);
}

// A circle of 200 m radius to the left, and a gyro that turns to the right by 0.5 deg/s on its own,
// as it also does when the car stands later: then that is known to 0.1 deg/s.
TEST(EgoMotion, FindsACircleBehindABiasedGyro) {
  Rows rows = rows_on_arc(0.005, from_degrees(-0.5));
  for (const std::size_t k : {40U, 41U, 42U, 150U}) {
    rows[k].speed = nan;
    rows[k].yaw_rate = nan;
  }
  rows.insert(rows.end(), 40, {.speed = 0.0, .yaw_rate = from_degrees(-0.5)});
  const auto made = ego_motion(rows, {10, 130}, {50, 190}, true);
  ASSERT_TRUE(made.has_value());
  EXPECT_NEAR(to_degrees(made->path.gyro_bias), -0.5, 0.1);
  EXPECT_NEAR(made->path.curvature, 0.005, from_degrees(0.1) / 14.0);  // at 14 m/s
  EXPECT_EQ(made->num_speed_missing, 1U);                              // of the scenario's rows
  EXPECT_EQ(made->speed.size(), 141U);
  ASSERT_EQ(made->path.poses.size(), 141U);
  EXPECT_EQ(made->path.poses[0].s, 0.0);
  EXPECT_LT(made->largest_offset, 0.1);
  for (std::size_t k = 0; k <= 80; ++k) {  // while the lane is kept
    EXPECT_NEAR(made->path.poses[k].d, 0.0, 0.1);
  }
  EXPECT_NEAR(made->yaw_rate[100] + made->path.gyro_bias, rows[150 - 1].yaw_rate, 0.01);
}

TEST(EgoMotion, OfTheMirroredRowsIsMirrored) {
  const auto left = ego_motion(rows_on_arc(0.004, 0.006), {0, 120}, {20, 190}, false);
  const auto right = ego_motion(rows_on_arc(-0.004, -0.006), {0, 120}, {20, 190}, false);
  ASSERT_TRUE(left && right);
  EXPECT_DOUBLE_EQ(left->path.curvature, -right->path.curvature);
  EXPECT_DOUBLE_EQ(left->path.gyro_bias, -right->path.gyro_bias);
  EXPECT_NEAR(left->path.poses.back().d, -right->path.poses.back().d, 1e-9);
}

// What comes after the conflict began has no part in where the lane lies.
TEST(EgoMotion, UsesNothingOfWhatTheDriverDoesLater) {
  Rows rows = rows_on_arc(0.001, 0.004);
  const auto before = ego_motion(rows, {0, 100}, {20, 190}, true);
  for (std::size_t k = 120; k < rows.size(); ++k) {
    rows[k].yaw_rate += 0.05;
  }
  const auto after = ego_motion(rows, {0, 100}, {20, 190}, true);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->path.curvature, after->path.curvature);
  EXPECT_EQ(before->path.gyro_bias, after->path.gyro_bias);
  EXPECT_EQ(before->path.poses[80].d, after->path.poses[80].d);
  EXPECT_GT(after->path.poses.back().d, before->path.poses.back().d + 1.0);
}

TEST(EgoMotion, IsNoneWhereTheSensorsWereBlindForLong) {
  Rows rows = rows_on_arc(0.0, 0.0);
  for (std::size_t k = 60; k < 76; ++k) {
    rows[k].speed = nan;
  }
  EXPECT_FALSE(ego_motion(rows, {0, 100}, {50, 190}, false).has_value());
  EXPECT_TRUE(ego_motion(rows, {80, 100}, {80, 190}, false).has_value());
  const Rows blind(50, {.speed = 10.0, .yaw_rate = nan});
  EXPECT_FALSE(ego_motion(blind, {0, 10}, {5, 49}, false).has_value());
  EXPECT_FALSE(ego_motion(blind, {0, 3}, {2, 5}, false).has_value());
  EXPECT_THROW((void)ego_motion(blind, {20, 30}, {5, 49}, false), ContractViolation);
  EXPECT_THROW((void)ego_motion(blind, {0, 30}, {5, 50}, false), ContractViolation);
}

}  // namespace
}  // namespace saca::importers::hundred_car_ego_test
