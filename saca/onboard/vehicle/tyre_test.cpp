#include "saca/onboard/vehicle/tyre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace saca::vehicle::tyre_test {
namespace {

constexpr Tyre tyre{.stiffness = 18.0, .shape = 1.4, .load_sensitivity = 0.1, .nominal_load = 4e3};

TEST(Tyre, SlopeAtZeroIsStiffnessTimesLoad) {
  // 1 mm/s of sliding at 10 m/s: slip 1e-4, far inside the straight part of the curve.
  const Vec2 F_T = tyre_force(tyre, {0.0, 1e-3}, 10.0, 5e3, 0.9);
  EXPECT_NEAR(F_T.y, -18.0 * 5e3 * 1e-4, 1e-3 * 9.0);
  EXPECT_EQ(F_T.x, 0.0);
}

// The library's own sine and arc tangent are the truth.
TEST(Tyre, FollowsTheMagicFormula) {
  for (const double shape : {1.05, 1.4, 1.9}) {
    for (double z = 1e-9; z < 1e9; z *= 1.3) {
      EXPECT_NEAR(z * magic_ratio(shape, z * z), std::sin(shape * std::atan(z)), 4e-12)
          << shape << ' ' << z;
    }
    EXPECT_NEAR(magic_ratio(shape, 0.0), shape, 1e-11);
  }
}

TEST(Tyre, IsSmoothThroughNoSlip) {
  const double below = tyre_force(tyre, {0.999e-8, 0.0}, 10.0, 4e3, 0.9).x / 0.999e-8;
  const double above = tyre_force(tyre, {1.001e-8, 0.0}, 10.0, 4e3, 0.9).x / 1.001e-8;
  EXPECT_NEAR(below / above, 1.0, 1e-9);
}

TEST(Tyre, NeverExceedsFrictionTimesLoadAndNeverPushesAlong) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> sliding(-30.0, 30.0);
  std::uniform_real_distribution<double> load(0.0, 9e3);
  std::uniform_real_distribution<double> grip(0.2, 1.2);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 v_slip_T{sliding(rng), sliding(rng)};
    const double N = load(rng);
    const double mu = grip(rng);
    const Vec2 F_T = tyre_force(tyre, v_slip_T, 15.0, N, mu);
    EXPECT_LE(norm(F_T), peak_friction(tyre, N, mu) * N * (1.0 + 1e-12));
    EXPECT_LE(dot(F_T, v_slip_T), 0.0);
  }
}

TEST(Tyre, HasNoPreferredDirection) {
  const Vec2 v_slip_T{0.7, -0.2};
  const Vec2 F_T = tyre_force(tyre, v_slip_T, 12.0, 4e3, 0.8);
  const Vec2 turned = tyre_force(tyre, rotated(v_slip_T, 1.1), 12.0, 4e3, 0.8);
  EXPECT_NEAR(turned.x, rotated(F_T, 1.1).x, 1e-9);
  EXPECT_NEAR(turned.y, rotated(F_T, 1.1).y, 1e-9);
}

TEST(Tyre, FallsAfterItsPeakTowardsTheShapesLimit) {
  const double peak_slip = slip_for(tyre, 0.9, 1.0);
  EXPECT_NEAR(force_share(tyre, 0.9, peak_slip), 1.0, 1e-12);
  EXPECT_LT(force_share(tyre, 0.9, 2.0 * peak_slip), 1.0);
  // sin(C atan(x)) tends to sin(C pi / 2).
  EXPECT_NEAR(force_share(tyre, 0.9, 1e9), std::sin(1.4 * std::numbers::pi / 2.0), 1e-6);
}

TEST(Tyre, SlipForUndoesForceShare) {
  for (const double share : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(force_share(tyre, 0.5, slip_for(tyre, 0.5, share)), share, 5e-12);
  }
}

TEST(Tyre, LosesFrictionWithLoad) {
  EXPECT_DOUBLE_EQ(peak_friction(tyre, 4e3, 0.9), 0.9);
  EXPECT_DOUBLE_EQ(peak_friction(tyre, 8e3, 0.9), 0.9 * (1.0 - 0.1));  // load doubled
  EXPECT_DOUBLE_EQ(peak_friction(tyre, 0.0, 0.9), 0.9 * (1.0 + 0.1));
}

TEST(Tyre, AnUnloadedWheelGivesNoForce) {
  EXPECT_EQ(norm(tyre_force(tyre, {1.0, 1.0}, 10.0, 0.0, 0.9)), 0.0);
}

}  // namespace
}  // namespace saca::vehicle::tyre_test
