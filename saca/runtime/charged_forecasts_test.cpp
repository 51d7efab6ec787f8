#include "saca/runtime/charged_forecasts.h"

#include <gtest/gtest.h>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "tests/support/scenes.h"

namespace saca::runtime::charged_forecasts_test {
namespace {

class ChargedForecastsTest : public ::testing::Test {
 protected:
  /// Offers a scene every 10 ms from 0 to `until`.
  void offer_until(ChargedForecasts& forecasts, double until) {
    for (int k = 0; 0.01 * k <= until + 1e-9; ++k) {
      world::Scene scene = test::ego_at(15.0);
      scene.time = 0.01 * k;
      forecasts.offer({.scene = scene, .beliefs = {}, .number = static_cast<std::uint64_t>(k)});
    }
  }

  static ChargedForecasts::Cost always(double cost) {
    return [cost](const TimedScene&) { return cost; };
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  arbitration::Judge judge_ = [one = arbitration::Forecaster({.car = &car_, .harm = &harm_}, 1)](
                                  const auto&... seen) { return one.judge(seen...); };
};

TEST_F(ChargedForecastsTest, AVerdictIsHeldBackUntilItWouldBeReady) {
  ChargedForecasts forecasts(judge_, always(0.03));
  offer_until(forecasts, 0.0);
  EXPECT_FALSE(forecasts.take(0.02).has_value());
  const auto verdict = forecasts.take(0.03);
  ASSERT_TRUE(verdict.has_value());
  EXPECT_EQ(verdict->verdict.time, 0.0);
  EXPECT_FALSE(forecasts.take(0.04).has_value()) << "it has been taken";
}

TEST_F(ChargedForecastsTest, TheNewestThatIsReadyIsTaken) {
  ChargedForecasts forecasts(judge_, always(0.03));
  offer_until(forecasts, 1.0);  // rounds at 0, 0.05, ... 1.0
  EXPECT_NEAR(forecasts.take(1.0)->verdict.time, 0.95, 1e-9);
  const auto last = forecasts.take(1.04);
  EXPECT_NEAR(last->verdict.time, 1.0, 1e-9);
  EXPECT_EQ(last->scene, 100U);
}

TEST_F(ChargedForecastsTest, WhatWasBegunForAnEncounterThatIsOverDoesNotCome) {
  ChargedForecasts forecasts(judge_, always(0.03));
  offer_until(forecasts, 1.0);
  forecasts.forget();
  EXPECT_FALSE(forecasts.take(2.0).has_value());
}

// Time jumps back by a second: rounds begin at once, not a second later.
TEST_F(ChargedForecastsTest, BeginsAnewWhereTimeJumps) {
  ChargedForecasts forecasts(judge_, always(0.03));
  offer_until(forecasts, 1.0);
  forecasts.begin_anew();
  offer_until(forecasts, 0.0);
  const auto verdict = forecasts.take(0.03);
  ASSERT_TRUE(verdict.has_value());
  EXPECT_EQ(verdict->scene, 0U);
}

TEST_F(ChargedForecastsTest, EachSceneCostsWhatItCosts) {
  ChargedForecasts forecasts(
      judge_, [](const TimedScene& one) { return one.scene.time < 0.2 ? 0.03 : 0.12; });
  offer_until(forecasts, 0.3);  // rounds at 0, 0.05, 0.1, 0.15, 0.2, 0.32
  EXPECT_NEAR(forecasts.take(0.3)->verdict.time, 0.15, 1e-9);
  EXPECT_NEAR(forecasts.take(0.32)->verdict.time, 0.2, 1e-9);
}

TEST_F(ChargedForecastsTest, ASlowForecasterBeginsFewerRounds) {
  ChargedForecasts forecasts(judge_, always(0.3));
  offer_until(forecasts, 1.0);  // rounds at 0, 0.3, 0.6, 0.9
  EXPECT_NEAR(forecasts.take(1.0)->verdict.time, 0.6, 1e-9);
}

}  // namespace
}  // namespace saca::runtime::charged_forecasts_test
