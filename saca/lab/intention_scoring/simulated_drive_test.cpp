#include "saca/lab/intention_scoring/simulated_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/chance.h"

namespace saca::intention_scoring::simulated_drive_test {
namespace {

constexpr double dt = DriveMotion::step;

DrivePlan steady(double speed) {
  DrivePlan plan;
  plan.speed.speed = speed;
  return plan;
}

std::vector<DrivePlan> drawn_plans(std::size_t count) {
  std::vector<DrivePlan> plans;
  for (std::size_t i = 0; i < count; ++i) {
    std::mt19937_64 rng = scenario::generator(1, i);
    plans.push_back(draw_plan(rng));
  }
  return plans;
}

double at(const std::vector<double>& series, double time) {
  return series.at(DriveMotion::before + static_cast<std::size_t>(std::lround(time / dt)));
}

TEST(SimulatedDrive, SpeedIsTheSlopeOfTheWay) {
  for (const DrivePlan& plan : drawn_plans(60)) {
    const DriveMotion motion = drive(plan);
    EXPECT_NEAR(motion.way.at(DriveMotion::before), 0.0, 1e-9);
    for (std::size_t i = 1; i < motion.way.size(); ++i) {
      const double mean = 0.5 * (motion.speed[i - 1] + motion.speed[i]);
      ASSERT_NEAR(motion.way[i] - motion.way[i - 1], mean * dt, 1e-9);
      ASSERT_NEAR(motion.speed[i] - motion.speed[i - 1], motion.acceleration[i] * dt, 1e-9);
      ASSERT_GE(motion.speed[i], 0.0);
    }
  }
}

TEST(SimulatedDrive, SlopeIsWayAsidePerWayAlong) {
  for (const DrivePlan& plan : drawn_plans(60)) {
    const DriveMotion motion = drive(plan);
    for (std::size_t i = 2; i + 1 < motion.way.size(); ++i) {
      const double along = motion.way[i + 1] - motion.way[i - 1];
      if (along > 0.01) {
        const double slope = (motion.aside[i + 1] - motion.aside[i - 1]) / along;
        // O(step^2) where it is smooth; a shift begins and ends without a kink.
        ASSERT_NEAR(motion.slope[i], slope, 2e-3) << i;
      }
    }
  }
}

TEST(SimulatedDrive, BrakingBuildsUpHoldsAndIsLetGo) {
  DrivePlan plan = steady(30.0);
  plan.speed.brakings = {
      {.start = 2.0, .build_up = 0.5, .deceleration = 6.0, .release = 4.0, .let_go = 0.4}};
  const DriveMotion motion = drive(plan);
  EXPECT_EQ(at(motion.acceleration, 1.9), 0.0);
  EXPECT_NEAR(at(motion.acceleration, 2.25), -3.0, 1e-9);
  EXPECT_NEAR(at(motion.acceleration, 3.0), -6.0, 1e-9);
  EXPECT_NEAR(at(motion.acceleration, 4.2), -3.0, 1e-9);
  EXPECT_NEAR(at(motion.acceleration, 4.5), 0.0, 1e-9);
  // The ramps count half: 0.25 + 1.5 + 0.2 s of 6 m/s^2; a sum over steps errs by half a step.
  EXPECT_NEAR(motion.speed.back(), 30.0 - 6.0 * 1.95, 6.0 * dt);
}

TEST(SimulatedDrive, WhoHasStoppedStays) {
  DrivePlan plan = steady(8.0);
  plan.speed.oscillations = {{{0.3, 4.0, 1.0}, {}}};
  plan.speed.brakings = {{.start = 1.0, .build_up = 0.2, .deceleration = 8.0}};
  const DriveMotion motion = drive(plan);
  EXPECT_EQ(at(motion.speed, 4.0), 0.0);
  EXPECT_EQ(at(motion.speed, 9.9), 0.0);
  EXPECT_EQ(at(motion.acceleration, 9.9), 0.0);
  EXPECT_EQ(at(motion.way, 4.0), at(motion.way, 9.9));
}

TEST(SimulatedDrive, ALaneChangeEndsInTheNextLane) {
  DrivePlan plan = steady(20.0);
  plan.shifts = {{.start = 2.0, .duration = 4.0, .aside = 3.5}};
  const DriveMotion motion = drive(plan);
  EXPECT_EQ(at(motion.aside, 2.0), 0.0);
  EXPECT_NEAR(at(motion.aside, 4.0), 1.75, 1e-6) << "half the way, half aside";
  // A quintic is steepest in its middle: 15/8 of the mean.
  EXPECT_NEAR(at(motion.slope, 4.0) * 20.0, 1.875 * 3.5 / 4.0, 1e-6);
  EXPECT_NEAR(at(motion.aside, 6.0), 3.5, 1e-6);
  EXPECT_NEAR(motion.aside.back(), 3.5, 1e-9);
}

TEST(SimulatedDrive, BrakingDoesNotKeepALaneChangeFromItsEnd) {
  DrivePlan plan = steady(25.0);
  plan.speed.brakings = {{.start = 2.0, .build_up = 0.3, .deceleration = 4.0}};
  plan.shifts = {{.start = 2.0, .duration = 3.0, .aside = -3.5}};
  const DriveMotion motion = drive(plan);
  EXPECT_NEAR(at(motion.aside, 5.0), -3.5, 1e-6);
}

TEST(SimulatedDrive, NobodyTurnsSharply) {
  DrivePlan plan = steady(5.0);
  plan.speed.brakings = {{.start = 2.0, .build_up = 0.2, .deceleration = 8.0}};
  plan.shifts = {{.start = 2.0, .duration = 2.0, .aside = 3.5}};
  const DriveMotion motion = drive(plan);
  EXPECT_LE(*std::max_element(motion.slope.begin(), motion.slope.end()), 1.875 / 6.0 + 1e-9);
  EXPECT_LT(motion.aside.back(), 1.0) << "it stops before";
}

TEST(SimulatedDrive, NobodyRunsIntoTheOneAhead) {
  std::size_t closing = 0;
  for (const DrivePlan& plan : drawn_plans(200)) {
    const DriveMotion motion = drive(plan);
    for (std::size_t i = 0; i < motion.gap.size(); ++i) {
      ASSERT_GE(motion.gap[i], 2.0 - 1e-9);
      ASSERT_EQ(std::isinf(motion.gap[i]), std::isnan(motion.lead_speed[i]));
    }
    closing += at(motion.lead_speed, 0.0) < at(motion.speed, 0.0) ? 1U : 0U;
  }
  EXPECT_GT(closing, 50U);
}

TEST(SimulatedDrive, TheLeadOfTheNextLaneCountsThere) {
  DrivePlan plan = steady(20.0);
  plan.shifts = {{.start = 2.0, .duration = 4.0, .aside = 3.5}};
  plan.lead = LeadPlan{.gap = 30.0, .speed = {.speed = 20.0}};
  plan.beside = LeadPlan{.gap = 60.0, .speed = {.speed = 25.0}};
  const DriveMotion motion = drive(plan);
  EXPECT_NEAR(at(motion.gap, 1.0), 30.0, 1e-9);
  EXPECT_NEAR(at(motion.lead_speed, 1.0), 20.0, 1e-9);
  EXPECT_NEAR(at(motion.gap, 8.0), 60.0 + 8.0 * 5.0, 1e-9);
  EXPECT_NEAR(at(motion.lead_speed, 8.0), 25.0, 1e-9);
}

TEST(SimulatedDrive, MirrorsExactly) {
  for (const DrivePlan& plan : drawn_plans(40)) {
    const DriveMotion motion = drive(plan);
    const DriveMotion turned = drive(mirrored(plan));
    EXPECT_EQ(motion.way, turned.way);
    EXPECT_EQ(motion.gap, turned.gap);
    for (std::size_t i = 0; i < motion.aside.size(); ++i) {
      ASSERT_EQ(motion.aside[i], -turned.aside[i]);
      ASSERT_EQ(motion.slope[i], -turned.slope[i]);
    }
  }
}

TEST(SimulatedDrive, DrawsStayWithinWhatIsStated) {
  for (const DrivePlan& plan : drawn_plans(500)) {
    EXPECT_GE(plan.duration, 8.0);
    EXPECT_LE(plan.duration, 14.0);
    EXPECT_GE(plan.speed.speed, 5.0);
    EXPECT_LE(plan.speed.speed, 35.0);
    EXPECT_LE(std::abs(plan.curvature) * plan.speed.speed * plan.speed.speed, 2.5 + 1e-9);
    for (const BrakingPlan& braking : plan.speed.brakings) {
      EXPECT_LE(braking.deceleration, 9.0);
      EXPECT_GE(braking.build_up, 0.2);
      EXPECT_LE(braking.build_up, 0.8);
    }
    EXPECT_LE(plan.perception.position_sd, 0.3);
    EXPECT_GE(plan.perception.position_sd, 0.05);
  }
}

TEST(SimulatedDrive, RefusesWhatCannotBeDriven) {
  DrivePlan plan = steady(-1.0);
  EXPECT_THROW((void)drive(plan), ContractViolation);
  plan = steady(1.0);
  plan.duration = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)drive(plan), ContractViolation);
  plan = steady(1.0);
  plan.lane_width = 0.0;
  EXPECT_THROW((void)drive(plan), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::simulated_drive_test
