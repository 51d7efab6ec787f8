#include "saca/lab/eval/likely_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/scenes.h"

namespace saca::eval::likely_places_test {
namespace {

/// North-bound, 2 m along and 0.5 m across.
LikelyPlace northward(double probability, Vec2 p_W) {
  return {probability, p_W, 0.5 * std::numbers::pi, {2.0, 0.5}};
}

// The density of a normal law of two dimensions.
TEST(PlaceScore, OfOnePlaceIsThatOfTheNormalLaw) {
  const std::vector<LikelyPlace> places{northward(1.0, {10.0, 20.0})};
  const PlaceScore there = score(places, {10.0, 20.0});
  EXPECT_NEAR(there.nll, std::log(2.0 * std::numbers::pi * 2.0 * 0.5), 1e-12);
  EXPECT_EQ(there.miss, 0.0);
  EXPECT_NEAR(there.pit_along, 0.5, 1e-12);
  const PlaceScore off = score(places, {9.5, 24.0});  // 4 m farther, half a metre to the left
  EXPECT_NEAR(off.nll - there.nll, 0.5 * (2.0 * 2.0 + 1.0), 1e-12);
  EXPECT_NEAR(off.miss, std::hypot(4.0, 0.5), 1e-12);
  EXPECT_NEAR(off.pit_along, 0.97725, 1e-5);
  EXPECT_NEAR(off.pit_across, 0.84134, 1e-5);
}

TEST(PlaceScore, OfTwoIsTheirMixture) {
  const std::vector<LikelyPlace> places{northward(0.25, {0.0, 0.0}), northward(0.75, {100.0, 0.0})};
  const double alone = std::log(2.0 * std::numbers::pi * 2.0 * 0.5);
  const PlaceScore both = score(places, {0.0, 0.0});
  EXPECT_NEAR(both.nll, alone + std::log(4.0), 1e-9);
  EXPECT_EQ(both.miss, 0.0);
  EXPECT_TRUE(std::isfinite(score(places, {1e6, 0.0}).nll)) << "however far";
}

// What is drawn from a forecast lies in its 90 % region nine times of ten.
TEST(PlaceScore, RegionsHoldWhatIsDrawnFromThem) {
  const std::vector<LikelyPlace> places{northward(0.3, {0.0, 0.0}), northward(0.7, {1.0, 3.0})};
  std::mt19937_64 rng(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any;
  int along = 0;
  int across = 0;
  constexpr int count = 4'000;
  for (int k = 0; k < count; ++k) {
    const LikelyPlace& one = places[any(rng) < 0.3 ? 0 : 1];
    const Vec2 error{one.spread.along_sd * normal(rng), one.spread.across_sd * normal(rng)};
    const PlaceScore told = score(places, one.p_W + rotated(error, one.course));
    along += std::abs(told.pit_along - 0.5) < 0.45 ? 1 : 0;
    across += std::abs(told.pit_across - 0.5) < 0.45 ? 1 : 0;
  }
  EXPECT_NEAR(along, 0.9 * count, 4.0 * std::sqrt(0.09 * count));
  EXPECT_NEAR(across, 0.9 * count, 4.0 * std::sqrt(0.09 * count));
}

TEST(PlaceScore, CountsTheLikeliestWaysOnly) {
  LikelyPlaces places;
  for (std::size_t k = 0; k < forecast_times.size(); ++k) {
    for (int i = 0; i < 8; ++i) {  // the eighth is right, and the least likely
      places[k].push_back(northward(0.125 + 0.01 * (3.5 - i), {7.0 - i, 0.0}));
    }
  }
  const std::array<Vec2, forecast_times.size()> truth{};
  EXPECT_NEAR(least_mean_miss(places, truth, 6), 2.0, 1e-12);
  EXPECT_NEAR(least_mean_miss(places, truth, 12), 0.0, 1e-12);
}

TEST(LikelyPlaces, OfWhoGoesStraightSpreadAsAnUnknownAccelerationDoes) {
  world::Actor car = test::car(1, {1.0, 2.0}, {6.0, 8.0});
  car.position_sd = 0.3;
  car.velocity_sd = 0.2;
  const LikelyPlaces places = going_straight(car);
  ASSERT_EQ(places[2].size(), 1U);
  EXPECT_NEAR(norm(places[2][0].p_W - Vec2{13.0, 18.0}), 0.0, 1e-12);
  EXPECT_NEAR(places[2][0].spread.along_sd, std::sqrt(0.3 * 0.3 + 0.4 * 0.4 + 2.0 * 2.0), 1e-12);
  EXPECT_NEAR(places[2][0].course, std::atan2(8.0, 6.0), 1e-12);
}

}  // namespace
}  // namespace saca::eval::likely_places_test
