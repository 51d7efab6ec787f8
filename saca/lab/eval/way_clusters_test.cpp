#include "saca/lab/eval/way_clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace saca::eval::way_clusters_test {
namespace {

/// To the same place at all times.
SampledWay to(Vec2 p) {
  SampledWay way;
  way.fill(p);
  return way;
}

// Six places far apart with four ways about each, 1 m to either side and along: each is a cluster
// with its weight, its mean and a variance of 1/2 m^2, beside 0.1 m that no place is known better.
TEST(WayClusters, AreFoundWithWeightMeanAndSpread) {
  std::vector<SampledWay> ways;
  std::vector<double> weights;
  for (int c = 0; c < 6; ++c) {
    for (const Vec2 off : {Vec2{1.0, 0.0}, Vec2{-1.0, 0.0}, Vec2{0.0, 1.0}, Vec2{0.0, -1.0}}) {
      ways.push_back(to(Vec2{100.0 * c, 0.0} + off));
      weights.push_back((c + 1.0) / (21.0 * 4.0));
    }
  }
  const LikelyPlaces places = clustered_places(ways, weights, {}, 1.0);
  for (const auto& at : places) {
    ASSERT_EQ(at.size(), 6U);
    for (const LikelyPlace& one : at) {
      const double c = std::round(one.p_W.x / 100.0);
      EXPECT_NEAR(one.p_W.x, 100.0 * c, 1e-9);
      EXPECT_NEAR(one.p_W.y, 0.0, 1e-9);
      EXPECT_NEAR(one.probability, (c + 1.0) / 21.0, 1e-12);
      EXPECT_NEAR(one.spread.along_sd, std::sqrt(0.5 + 0.01), 1e-9);
      EXPECT_NEAR(one.spread.across_sd, std::sqrt(0.5 + 0.01), 1e-9);
    }
  }
}

// Fewer places than clusters: nothing is made up, and mean and variance of all are kept.
TEST(WayClusters, OfOnePlaceAreOne) {
  const std::vector<SampledWay> ways(10, to({5.0, 2.0}));
  const LikelyPlaces places = clustered_places(ways, std::vector<double>(10, 0.1), {}, 1.0);
  ASSERT_EQ(places[0].size(), 1U);
  EXPECT_NEAR(places[0][0].probability, 1.0, 1e-12);
  EXPECT_NEAR(places[0][0].spread.along_sd, 0.1, 1e-6);
}

// Against a road that turns left by a quarter over 50 pi metres, 10 m beside it.
TEST(WayClusters, LieOnTheRoadInTheDirectionOfTravel) {
  const world::Road bend{.curvature = 0.01, .left_edge = 20.0, .right_edge = -20.0};
  const SampledWay there = to({-50.0 * std::numbers::pi, -10.0});
  const LikelyPlaces places = clustered_places({there}, {1.0}, bend, -1.0);
  EXPECT_NEAR(places[0][0].p_W.x, 90.0, 1e-9);
  EXPECT_NEAR(places[0][0].p_W.y, 100.0, 1e-9);
  EXPECT_NEAR(std::cos(places[0][0].course + 0.5 * std::numbers::pi), 1.0, 1e-9);
}

}  // namespace
}  // namespace saca::eval::way_clusters_test
