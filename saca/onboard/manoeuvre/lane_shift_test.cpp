#include "saca/onboard/manoeuvre/lane_shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace saca::manoeuvre::lane_shift_test {
namespace {

TEST(LaneShift, EndsAtRestWhereItShould) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> rate(-1.5, 1.5);
  std::uniform_real_distribution<double> amplitude(1.0, 9.0);
  for (int i = 0; i < 500; ++i) {
    const double start = place(rng);
    const double end = start + std::copysign(2.0 + std::abs(place(rng)), place(rng));
    const LaneShift shift = lane_shift(start, rate(rng), end, amplitude(rng), 0.15);
    EXPECT_NEAR(at(shift, duration(shift)).d, end, 1e-9);
    EXPECT_NEAR(at(shift, duration(shift) - 1e-9).v, 0.0, 1e-6);
    EXPECT_GE(shift.first, 0.0);
    EXPECT_GE(shift.second, 0.0);
  }
}

// From rest: way = A (hold + ramp) (hold + 2 ramp), twice hold + 4 ramps long.
TEST(LaneShift, TakesTheTimeOfItsTrapezes) {
  const LaneShift shift = lane_shift(0.0, 0.0, 3.5, 7.0, 0.2);
  // hold^2 + 0.6 hold + 0.08 = 0.5: hold = 0.414143 s.
  EXPECT_NEAR(duration(shift), 2.0 * 0.414143 + 0.8, 1e-5);
}

TEST(LaneShift, RateIsTheSlopeOfTheOffsetAndAccelerationOfTheRate) {
  const LaneShift shift = lane_shift(0.4, -0.5, 3.5, 5.0, 0.2);
  constexpr double h = 1e-5;
  for (int i = 1; i < 40; ++i) {
    const double t = i / 40.0 * duration(shift);
    const Lateral before = at(shift, t - h);
    const Lateral after = at(shift, t + h);
    EXPECT_NEAR((after.d - before.d) / (2.0 * h), at(shift, t).v, 1e-6);
    EXPECT_NEAR((after.v - before.v) / (2.0 * h), at(shift, t).a, 1e-3);
    EXPECT_LE(std::abs(at(shift, t).a), 5.0 + 1e-12);
    EXPECT_LE(std::abs(at(shift, t).v), largest_rate(shift) + 1e-12);
  }
}

TEST(LaneShift, GoesOnBeforeItsStartAndStandsAfterItsEnd) {
  const LaneShift shift = lane_shift(1.0, 0.5, 4.0, 5.0, 0.2);
  EXPECT_DOUBLE_EQ(at(shift, -0.1).d, 1.0 - 0.05);
  EXPECT_DOUBLE_EQ(at(shift, -0.1).v, 0.5);
  EXPECT_EQ(at(shift, duration(shift) + 1.0).v, 0.0);
  EXPECT_EQ(at(shift, duration(shift) + 1.0).a, 0.0);
}

TEST(LaneShift, LeftIsTheMirrorOfRight) {
  const LaneShift left = lane_shift(0.2, 0.3, 3.5, 6.0, 0.15);
  const LaneShift right = lane_shift(-0.2, -0.3, -3.5, 6.0, 0.15);
  for (int i = 0; i < 20; ++i) {
    const double t = 0.1 * i;
    EXPECT_DOUBLE_EQ(at(left, t).d, -at(right, t).d);
  }
}

TEST(LaneShift, OfNoWayIsNone) {
  const LaneShift shift = lane_shift(1.0, 0.0, 1.0, 5.0, 0.2);
  for (const double t : {0.0, 0.1, 0.5, 2.0}) {
    EXPECT_NEAR(at(shift, t).d, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace saca::manoeuvre::lane_shift_test
