#include "saca/lab/learned_danger/check.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::learned_danger::check_test {
namespace {

CheckedCase one(double told, double acted, double best) {
  return {.speed = 10.0, .grip = 0.9, .told = told, .acted = acted, .best = best};
}

const auto no_margin = [](const CheckedCase&) { return 0.0; };

// Six situations that can be counted by hand.
TEST(CheckFigures, AreSharesOfWhatTheySay) {
  const std::vector<CheckedCase> all{one(-1.5, -1.2, -1.2),  // told safe, is
                                     one(-0.5, 0.1, -0.1),  // told safe, evaded by others, hit by Q
                                     one(-0.2, 0.4, 0.4),   // told safe, hit by all
                                     one(0.5, 0.6, 0.6),    // told unsafe, is
                                     one(0.3, -0.7, -0.7),  // false alarm
                                     one(-15.0, -30.0, -30.0)};  // far
  const CheckFigures figures = figures_of(all, no_margin);
  EXPECT_EQ(figures.hit_given_told_safe.count, 2);
  EXPECT_EQ(figures.hit_given_told_safe.of, 4);
  EXPECT_EQ(figures.hit_given_just_safe.count, 2);
  EXPECT_EQ(figures.hit_given_just_safe.of, 2);
  EXPECT_EQ(figures.told_safe_given_hit.count, 1);
  EXPECT_EQ(figures.told_safe_given_hit.of, 2);
  EXPECT_EQ(figures.false_alarms.count, 1);
  EXPECT_EQ(figures.false_alarms.of, 4);
  EXPECT_EQ(figures.agreeing_near.of, 5);
  EXPECT_EQ(figures.agreeing_near.count, 3);
  EXPECT_NEAR(figures.mean_error_near, (0.3 + 0.4 + 0.6 + 0.1 + 1.0) / 5.0, 1e-12);
  EXPECT_NEAR(figures.bias_near, (-0.3 - 0.4 - 0.6 - 0.1 + 1.0) / 5.0, 1e-12);
  EXPECT_NEAR(figures.p99_error_near, 1.0, 1e-12);
  EXPECT_NEAR(figures.lost_near, 0.2 / 5.0, 1e-12);
  EXPECT_EQ(figures.pincers.of, 0);

  const CheckFigures careful = figures_of(all, [](const CheckedCase&) { return 0.6; });
  EXPECT_EQ(careful.hit_given_told_safe.count, 0);
  EXPECT_EQ(careful.hit_given_told_safe.of, 2);
  EXPECT_EQ(careful.false_alarms.count, 2);
  EXPECT_EQ(figures_of({}, no_margin).hit_given_told_safe.value(), 0.0);
}

TEST(CheckFigures, CountPincers) {
  CheckedCase pincer = one(0.5, 0.4, 0.3);
  pincer.num_obstacles = 2;
  pincer.told_alone = -0.5;
  pincer.is_pincer = true;
  CheckedCase apart = one(-3.0, -3.0, -3.0);
  apart.num_obstacles = 3;
  const CheckFigures figures = figures_of({pincer, apart, one(0.1, 0.1, 0.1)}, no_margin);
  EXPECT_EQ(figures.pincers.count, 1);
  EXPECT_EQ(figures.pincers.of, 2);
  EXPECT_EQ(figures.told_of_pincers.count, 1);
  EXPECT_EQ(figures.told_of_pincers.of, 1);
  EXPECT_EQ(figures.told_alone_of_pincers.count, 0);
}

// What is not wanted, or told unsafe, is not driven; what is driven does not depend on the others.
TEST(DrivenByEvasion, IsWhatIsToldSafeInABinThatIsWanted) {
  const manoeuvre::Car car = prepare::default_car();
  const Network network = Network::from(networks_that_hand_on(), "weights").value();
  std::array<bool, num_bins> all{};
  all.fill(true);
  int driven = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto one = driven_by_evasion(car, manoeuvre::footprint(car), network, seed, all);
    const auto none = driven_by_evasion(car, manoeuvre::footprint(car), network, seed, {});
    EXPECT_EQ(one.acted.has_value(), one.told < 0.0);
    EXPECT_FALSE(none.acted.has_value());
    EXPECT_EQ(one.bin, none.bin);
    EXPECT_EQ(one.told, none.told);
    driven += one.acted ? 1 : 0;
  }
  EXPECT_GT(driven, 0);
}

}  // namespace
}  // namespace saca::learned_danger::check_test
