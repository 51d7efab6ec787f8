#include "saca/lab/eval/danger_choice.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/networks_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/scenes.h"

namespace saca::eval::danger_choice_test {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;

/// V_h is h and a constant: whoever is farthest from all after half a second has the least Q_h.
learned_danger::Network by_distance() {
  return learned_danger::Network::from(learned_danger::networks_that_hand_on(), "weights").value();
}

world::Scene scene_at(double speed) {
  world::Scene scene = test::ego_at(speed, manoeuvre::footprint(prepare::default_car()));
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -8.75;
  return scene;
}

TEST(OfLeastDanger, BeforeOneThatStandsAheadTheHardestBrakingIsFarthestFromIt) {
  const manoeuvre::Car car = prepare::default_car();
  world::Scene scene = scene_at(15.0);
  scene.actors.push_back(test::car(1, {18.0, 0.0}));
  for (const Beside beside : {Beside::each, Beside::all}) {
    const Plan plan =
        of_least_danger(scene, drivable_plans(car, scene), car, by_distance(), beside);
    EXPECT_EQ(plan.policy, PolicyId::aeb);
    EXPECT_FALSE(plan.strength.has_value());
  }
}

TEST(OfLeastDanger, BesideOneThatIsAlongsideTheLaneChangeAwayIs) {
  const manoeuvre::Car car = prepare::default_car();
  world::Scene scene = scene_at(15.0);
  scene.actors.push_back(test::car(1, {0.5, 2.4}, {15.0, 0.0}));
  const std::vector<Plan> plans{
      {PolicyId::aes_left, {}}, {PolicyId::no_intervention, {}}, {PolicyId::aes_right, {}}};
  EXPECT_EQ(of_least_danger(scene, plans, car, by_distance(), Beside::each).policy,
            PolicyId::aes_right);
}

TEST(OfLeastDanger, WithNobodyAheadTheFirstOfEqualOnesIsTaken) {
  const world::Scene scene = scene_at(15.0);
  const std::vector<Plan> plans{{PolicyId::aes_right, {}}, {PolicyId::aeb, {}}};
  EXPECT_EQ(
      of_least_danger(scene, plans, prepare::default_car(), by_distance(), Beside::all).policy,
      PolicyId::aes_right);
  EXPECT_THROW((void)of_least_danger(scene, {}, prepare::default_car(), by_distance(), Beside::all),
               ContractViolation);
}

TEST(DrivablePlans, AtACrawlAreThoseThatNeedNoSpeed) {
  for (const Plan& plan : drivable_plans(prepare::default_car(), scene_at(1.0))) {
    EXPECT_TRUE(plan.policy == PolicyId::aeb || plan.policy == PolicyId::no_intervention);
  }
}

// The least is 0.1; 3 % of what full braking has above it are 0.012.
TEST(AdmissiblePlans, HarmAsLittleAsForecastsCanTell) {
  const std::vector<preview::ExpectedHarm> all{
      {{PolicyId::aeb, {}}, "", 0.5, 1.0},
      {{PolicyId::aes_left, {}}, "", 0.1, 0.2},
      {{PolicyId::aes_right, {}}, "", 0.111, 0.2},
      {{PolicyId::no_intervention, {}}, "", 0.113, 0.2},
      {{PolicyId::t_drift_left, {}}, "too slow", 0.0, 0.0}};
  const auto plans = admissible_plans(all);
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].policy, PolicyId::aes_left);
  EXPECT_EQ(plans[1].policy, PolicyId::aes_right);
  EXPECT_EQ(admissible_plans({{{PolicyId::aes_left, {}}, "too slow", 0.0, 0.0}}),
            std::vector{manoeuvre::full_braking});
}

}  // namespace
}  // namespace saca::eval::danger_choice_test
