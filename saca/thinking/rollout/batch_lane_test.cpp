#include "saca/thinking/rollout/batch_lane.h"

#include <gtest/gtest.h>

#include "saca/thinking/rollout/batch_start.h"

// What the lanes do otherwise than the scalar model, for `double`: at its own step they must agree.
namespace saca::rollout::lanes::batch_lane_test {
namespace {

TEST(BatchLane, ShiftIsThatOfTheScalarModel) {
  for (const double end_d : {-3.5, 0.4, 3.5}) {
    for (const double start_v : {-0.6, 0.0, 0.8}) {
      const manoeuvre::LaneShift shift = manoeuvre::lane_shift(0.2, start_v, end_d, 5.0, 0.15);
      const ShiftLane<double> lane = shift_lane<double>(shift);
      for (int i = -20; i < 400; ++i) {
        const double time = 0.01 * i + 0.0037;
        const manoeuvre::Lateral theirs = at(shift, time);
        const manoeuvre::equations::Lateral<double> ours = at<double>(lane, time);
        EXPECT_NEAR(ours.d, theirs.d, 1e-10) << time;
        EXPECT_NEAR(ours.v, theirs.v, 1e-10) << time;
        EXPECT_NEAR(ours.a, theirs.a, 1e-10) << time;
      }
    }
  }
}

// The anti-lock brake's memory of both kinds, through the same slips.
TEST(BatchLane, CorrectionsAtTheScalarModelsStepAreItsOwn) {
  constexpr double dt = vehicle::usual_step;
  vehicle::AbsState scalar = vehicle::begin_abs(20.0);
  AbsLane<double> lane{.speed = 20.0, .share = {1, 1, 1, 1}, .slip = {}, .growth = {}};
  for (int i = 0; i < 50; ++i) {
    const double slip = 0.002 * i;
    const vehicle::PerWheel slips{slip, 0.5 * slip, -slip, 0.05};
    const auto theirs = vehicle::equations::next_corrections<double, bool>(scalar, slips, 0.09,
                                                                           i % 2 == 0, 0.9, dt);
    const auto ours = next_corrections<double, bool>(lane, slips, 0.09, i % 2 == 0, 0.9, dt);
    for (std::size_t wheel = 0; wheel < vehicle::num_wheels; ++wheel) {
      EXPECT_NEAR(ours[wheel].learning, theirs[wheel].learning, 1e-9) << i;
      EXPECT_NEAR(ours[wheel].too_much, theirs[wheel].too_much, 1e-9) << i;
    }
  }
}

TEST(BatchLane, FirstCallAfterAPauseTeachesAsMuchInAnyStep) {
  // Within its first 1 ms the scalar model takes the whole slip for growth; then there is none.
  constexpr double dt = 5.0 * vehicle::usual_step;
  const vehicle::PerWheel slips{0.03, 0.03, 0.03, 0.03};
  vehicle::AbsState scalar = vehicle::begin_abs(20.0);
  double learnt = 0.0;
  for (int i = 0; i < 5; ++i) {
    learnt += vehicle::usual_step * vehicle::equations::next_corrections<double, bool>(
                                        scalar, slips, 0.09, true, 1.0, vehicle::usual_step)[0]
                                        .learning;
  }
  AbsLane<double> lane{.speed = 20.0, .share = {1, 1, 1, 1}, .slip = {}, .growth = {}};
  const auto ours = next_corrections<double, bool>(lane, slips, 0.09, true, 1.0, dt);
  EXPECT_NEAR(dt * ours[0].learning, learnt, 1e-12);
}

TEST(BatchLane, GrowthThatGrowsEvenlyIsAsOldAsTheScalarModels) {
  // r = t^2 / 2: a growth of t, told half a call late, by the scalar model at its 1 ms.
  constexpr double dt = 4e-3;
  DriftMemoryLane<double> memory{};
  for (int i = 1; i < 10; ++i) {
    const double t = dt * i;
    const double growth = turning_growth(memory, 0.5 * t * t, dt);
    if (i > 2) {
      EXPECT_NEAR(growth, t - 0.5 * vehicle::usual_step, 1e-12);
    }
  }
}

TEST(BatchLane, SmoothsAsFarAsTheScalarModelInAsLong) {
  constexpr double time = 0.02;
  double left = 1.0;
  for (int i = 0; i < 5; ++i) {
    left *= 1.0 - vehicle::usual_step / time;
  }
  EXPECT_NEAR(smoothed(5.0 * vehicle::usual_step, time), 1.0 - left, 1e-12);
  EXPECT_NEAR(smoothed(vehicle::usual_step, time), vehicle::usual_step / time, 1e-12);
}

}  // namespace
}  // namespace saca::rollout::lanes::batch_lane_test
