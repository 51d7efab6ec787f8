#include "saca/lab/eval/driver_models.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "tests/support/scenes.h"

namespace saca::eval::driver_models_test {
namespace {

using manoeuvre::PolicyId;

class DriverModels : public testing::Test {
 protected:
  /// 20 m/s towards a standing car, seen every 10 ms from a gap on: gap and deceleration of each
  /// action, while the ego goes on as if nothing were done.
  std::vector<std::pair<double, double>> actions(encounter::Method& method, double from) {
    std::vector<std::pair<double, double>> all;
    for (int k = 0; 0.2 * k < from; ++k) {
      world::Scene scene = test::ego_at(20.0);
      scene.time = 0.01 * k;
      const double gap = from - 0.2 * k;
      scene.actors.push_back(test::car(1, {2.35 + gap + 2.25, 0.0}));
      if (const auto action = truth_.step(method, scene)) {
        EXPECT_EQ(action->plan.policy, PolicyId::aeb);
        all.emplace_back(gap, action->deceleration);
      }
    }
    return all;
  }

  UnseenTruth truth_;
};

// 20 m/s / (2 * 6) + 0.35 s = 2.0167 s, that is 40.33 m; 0.35 s later 7 m have gone.
TEST_F(DriverModels, TheRuleOfUnR157BrakesWithSixHalfwayThroughItsTime) {
  R157Braking rule;
  const auto all = actions(rule, 60.0);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].first, 40.33 - 7.0, 0.41);
  EXPECT_EQ(all[0].second, 6.0);
}

// Seen at 40 m; 0.75 s later 15 m have gone; then 12.65 m/s^3 up to 7.593 m/s^2 in 0.6 s.
TEST_F(DriverModels, TheCompetentDriverBuildsItsBrakingUp) {
  CompetentDriver driver;
  const auto all = actions(driver, 60.0);
  ASSERT_GE(all.size(), 60U);
  EXPECT_NEAR(all.front().first, 40.0 - 15.0, 0.41);
  EXPECT_NEAR(all.back().second, 0.774 * 9.81, 1e-9);
  EXPECT_NEAR(all.front().first - all.back().first, 20.0 * 0.774 * 9.81 / 12.65, 0.41);
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_GE(all[k].second, all[k - 1].second);
  }
}

TEST_F(DriverModels, NobodyBrakesForWhoDrivesAwayOrIsBeside) {
  R157Braking rule;
  CompetentDriver driver;
  FuzzySafety fuzzy;
  for (encounter::Method* const method :
       {static_cast<encounter::Method*>(&rule), static_cast<encounter::Method*>(&driver),
        static_cast<encounter::Method*>(&fuzzy)}) {
    world::Scene scene = test::ego_at(20.0);
    scene.actors.push_back(test::car(1, {60.0, 0.0}, {25.0, 0.0}));
    scene.actors.push_back(test::car(2, {12.0, 3.7}, {10.0, 0.0}));
    for (int k = 0; k < 200; ++k) {
      scene.time = 0.01 * k;
      EXPECT_EQ(truth_.step(*method, scene), std::nullopt);
    }
  }
}

// By hand from Mattas et al.: speed 20, ahead 10. CFS at constant speed: safe beyond
// (20 - 10) * 0.75 + 10^2 / (2 * 4) = 20 m, unsafe below 7.5 + 10^2 / (2 * 6) = 15.83 m.
// PFS: safe beyond 2 + 20 * 0.75 + 400 / 8 - 100 / 14 + 2 = 61.857 m,
// unsafe below 2 + 15 + 400 / 12 - 100 / 14 = 43.190 m.
TEST(FuzzySurrogatesTest, AreLinearBetweenTheirTwoDistances) {
  EXPECT_EQ(fuzzy_surrogates(20.01, 20.0, 10.0, 0.0).critical, 0.0);
  EXPECT_EQ(fuzzy_surrogates(15.8, 20.0, 10.0, 0.0).critical, 1.0);
  EXPECT_NEAR(fuzzy_surrogates(0.5 * (20.0 + 15.8333333), 20.0, 10.0, 0.0).critical, 0.5, 1e-6);
  EXPECT_EQ(fuzzy_surrogates(61.86, 20.0, 10.0, 0.0).proactive, 0.0);
  EXPECT_EQ(fuzzy_surrogates(43.1, 20.0, 10.0, 0.0).proactive, 1.0);
  EXPECT_NEAR(fuzzy_surrogates(0.5 * (61.857143 + 43.190476), 20.0, 10.0, 0.0).proactive, 0.5,
              1e-6);
  EXPECT_EQ(fuzzy_surrogates(5.0, 10.0, 10.0, 0.0).critical, 0.0);  // they do not close
}

TEST_F(DriverModels, TheFuzzyModelLetsGoWhenBothDistancesAreKeptAgain) {
  FuzzySafety fuzzy;
  EXPECT_FALSE(actions(fuzzy, 60.0).empty());
  world::Scene scene = test::ego_at(20.0);
  scene.time = 10.0;
  const auto goes = truth_.step(fuzzy, scene);
  ASSERT_TRUE(goes.has_value());
  EXPECT_EQ(goes->plan.policy, PolicyId::no_intervention);
}

// As in JRC's FSM_react: 0.75 s are taken once, in looks at a risk; a risk that was away for a
// moment is braked for at once.
TEST_F(DriverModels, TheFuzzyModelReactsOnce) {
  FuzzySafety fuzzy;
  const auto look = [&](int k, bool risk) {
    world::Scene scene = test::ego_at(20.0);
    scene.time = 0.01 * k;
    if (risk) {
      scene.actors.push_back(test::car(1, {2.35 + 30.0 + 2.25, 0.0}));
    }
    return truth_.step(fuzzy, scene);
  };
  for (int k = 0; k < 76; ++k) {
    EXPECT_EQ(look(k, k != 50), std::nullopt) << "one look without is no new reaction: " << k;
  }
  const auto first = look(76, true);
  ASSERT_TRUE(first.has_value());
  EXPECT_NEAR(first->deceleration, 0.1265, 1e-9);
  double last = 0.0;
  for (int k = 77; k < 96; ++k) {
    last = look(k, true)->deceleration;
  }
  EXPECT_NEAR(last, 20 * 0.1265, 1e-9);
  EXPECT_EQ(look(96, false)->plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(look(97, false), std::nullopt);
  EXPECT_NEAR(look(98, true)->deceleration, 21 * 0.1265, 1e-9);
}

}  // namespace
}  // namespace saca::eval::driver_models_test
