#include "saca/lab/eval/forecast_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/lab/eval/scenes_for_test.h"
#include "tests/support/scenes.h"

namespace saca::eval::forecast_score_test {
namespace {

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
  scenario::Scenario scenario = standing_car(20.0, 60.0);
  scenario.duration = 6.0;
  scenario.actors[0].motion = scenario::Script{
      .start = {.s = 60.0}, .speed = 20.0, .behaviour = scenario::Behaviour::constant_velocity};
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  const auto samples = forecast_samples(stage, shipped_models()).value();
  ASSERT_EQ(samples.size(), 5U);  // 0.5, 1.0, ... 2.5 s; 3 s later it is still there
  for (const ForecastSample& one : samples) {
    EXPECT_EQ(one.who, "car1");
    EXPECT_FALSE(one.acts);
    for (const MotionModel model : motion_models) {
      const PlaceScore& last = one.scores[static_cast<std::size_t>(model)].back();
      // What was drawn or learnt is right but for some of what people do within 3 s.
      const bool is_rough =
          model == MotionModel::particle_filter || model == MotionModel::mixture_lstm;
      EXPECT_LT(last.miss, is_rough ? 1.5 : 0.1) << name(model);
      EXPECT_NEAR(last.pit_along, 0.5, is_rough ? 0.4 : 0.1) << name(model);
    }
  }
}

// It brakes at 6 m/s2 from 2 s on: it acts, and straight on is wrong.
TEST(ForecastSamples, OfWhoBrakesAct) {
  const scenario::Scenario scenario = car_that_brakes();
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  for (const ForecastSample& one : forecast_samples(stage, shipped_models()).value()) {
    EXPECT_EQ(one.acts, one.time > 0.8) << one.time;
  }
}

/// The car ahead, recorded for so long at 20 m/s.
scenario::Scenario recorded_for(double seconds) {
  scenario::Scenario scenario = standing_car(20.0, 60.0);
  scenario.duration = 9.0;
  scenario::Recording samples;
  for (int k = 0; k <= std::lround(10.0 * seconds); ++k) {
    samples.push_back({0.1 * k, {{60.0 + 2.0 * k, 0.0}, 0.0}, 20.0, 0.0});
  }
  scenario.actors[0].motion = samples;
  return scenario;
}

// Beyond a recording's end everybody goes straight on, which nobody has seen: 3 s before it and
// later nothing is forecast.
TEST(ForecastSamples, OfWhoIsRecordedEndWithTheRecording) {
  const scenario::Scenario scenario = recorded_for(5.0);
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  EXPECT_EQ(forecast_samples(stage, shipped_models()).value().size(), 4U);  // 0.5 to 2 s
}

TEST(ForecastSamples, CountWithinTheirWindow) {
  const scenario::Scenario scenario = recorded_for(8.0);
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  const auto num = [&](const ForecastWindow& window) {
    return forecast_samples(stage, shipped_models(), window).value().size();
  };
  EXPECT_EQ(num({}), 10U);                                // 0.5 to 5 s
  EXPECT_EQ(num({.from = 1.0, .until = 2.0}), 3U);        // 1, 1.5, 2 s
  EXPECT_EQ(num({.settling = {.before_end = 1.0}}), 8U);  // 0.5 to 4 s
  EXPECT_EQ(num({.lane_ahead = 60.0 + 2.0 * 15.0}), 3U);  // where it is at 0.5, 1, 1.5 s
}

}  // namespace
}  // namespace saca::eval::forecast_score_test
