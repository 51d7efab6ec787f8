#include "saca/eval/forecast_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/eval/scenes_for_test.h"
#include "tests/support/scenes.h"

namespace saca::eval::forecast_score_test {
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

TEST(PlacesOf, ConstantVelocityAndTurn) {
  world::Scene scene = test::ego_at(20.0);
  scene.actors.push_back(test::car(1, {0.0, 0.0}, {10.0, 0.0}));
  world::Actor& car = scene.actors[0];
  car.yaw_rate = 0.5;
  car.a_W = {-2.0, 0.0};
  const LikelyPlaces straight = places_of(MotionModel::constant_velocity, scene, car, {});
  EXPECT_NEAR(straight[2][0].p_W.x, 20.0, 1e-12);
  // An arc whose speed falls: x = int (10 - 2 t) cos(t / 2) dt, y likewise with the sine.
  const auto antiderivative = [](double t) {
    const double s = std::sin(0.5 * t);
    const double c = std::cos(0.5 * t);
    return Vec2{(10.0 - 2.0 * t) * 2.0 * s - 8.0 * c, -(10.0 - 2.0 * t) * 2.0 * c - 8.0 * s};
  };
  const LikelyPlaces turning = places_of(MotionModel::constant_turn, scene, car, {});
  const Vec2 expected = antiderivative(2.0) - antiderivative(0.0);
  EXPECT_NEAR(norm(turning[2][0].p_W - expected), 0.0, 2e-3);
  EXPECT_NEAR(turning[2][0].course, 1.0, 1e-12);
  EXPECT_EQ(turning[3][0].spread.along_sd, 4.5);
}

// A car ahead that keeps its speed, seen exactly: who says so is right, and nobody acts.
TEST(ForecastSamples, OfWhoGoesOnAreForetoldByAll) {
  sim::Scenario scenario = standing_car(20.0, 60.0);
  scenario.duration = 6.0;
  scenario.actors[0].motion = sim::Script{
      .start = {.s = 60.0}, .speed = 20.0, .behaviour = sim::Behaviour::constant_velocity};
  const manoeuvre::Car car = manoeuvre::default_car();
  const outcome::HarmModel harm = shipped_harm();
  const loop::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  const auto samples = forecast_samples(stage).value();
  ASSERT_EQ(samples.size(), 5U);  // 0.5, 1.0, ... 2.5 s; 3 s later it is still there
  for (const ForecastSample& one : samples) {
    EXPECT_EQ(one.who, "car1");
    EXPECT_FALSE(one.acts);
    for (const auto& scores : one.scores) {
      EXPECT_LT(scores.back().miss, 0.1);
      EXPECT_NEAR(scores.back().pit_along, 0.5, 0.1);
    }
  }
}

// It brakes at 6 m/s2 from 2 s on: it acts, and straight on is wrong.
TEST(ForecastSamples, OfWhoBrakesAct) {
  const sim::Scenario scenario = car_that_brakes();
  const manoeuvre::Car car = manoeuvre::default_car();
  const outcome::HarmModel harm = shipped_harm();
  const loop::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  for (const ForecastSample& one : forecast_samples(stage).value()) {
    EXPECT_EQ(one.acts, one.time > 0.8) << one.time;
  }
}

/// The car ahead, recorded for so long at 20 m/s.
sim::Scenario recorded_for(double seconds) {
  sim::Scenario scenario = standing_car(20.0, 60.0);
  scenario.duration = 9.0;
  sim::Recording samples;
  for (int k = 0; k <= std::lround(10.0 * seconds); ++k) {
    samples.push_back({0.1 * k, {{60.0 + 2.0 * k, 0.0}, 0.0}, 20.0, 0.0});
  }
  scenario.actors[0].motion = samples;
  return scenario;
}

// Beyond a recording's end everybody goes straight on, which nobody has seen: 3 s before it and
// later nothing is forecast.
TEST(ForecastSamples, OfWhoIsRecordedEndWithTheRecording) {
  const sim::Scenario scenario = recorded_for(5.0);
  const manoeuvre::Car car = manoeuvre::default_car();
  const outcome::HarmModel harm = shipped_harm();
  const loop::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  EXPECT_EQ(forecast_samples(stage).value().size(), 4U);  // 0.5 to 2 s
}

TEST(ForecastSamples, CountWithinTheirWindow) {
  const sim::Scenario scenario = recorded_for(8.0);
  const manoeuvre::Car car = manoeuvre::default_car();
  const outcome::HarmModel harm = shipped_harm();
  const loop::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  const auto num = [&](const ForecastWindow& window) {
    return forecast_samples(stage, window).value().size();
  };
  EXPECT_EQ(num({}), 10U);                                // 0.5 to 5 s
  EXPECT_EQ(num({.from = 1.0, .until = 2.0}), 3U);        // 1, 1.5, 2 s
  EXPECT_EQ(num({.settling = {.before_end = 1.0}}), 8U);  // 0.5 to 4 s
  EXPECT_EQ(num({.lane_ahead = 60.0 + 2.0 * 15.0}), 3U);  // where it is at 0.5, 1, 1.5 s
}

}  // namespace
}  // namespace saca::eval::forecast_score_test
