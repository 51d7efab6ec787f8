#include "saca/lab/eval/trigger_case.h"

#include <gtest/gtest.h>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::trigger_case_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;

constexpr std::size_t draws = 16;

class TriggerCase : public testing::Test {
 protected:
  [[nodiscard]] Result<std::optional<memory::Case>> of(const scenario::Scenario& scenario) const {
    return case_at_trigger({&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}},
                           {&car_, &harm_}, draws,
                           encounter::made_with({&car_, &harm_}, intent::shipped_model(), "a car"));
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

// Braking needs 49 m and has 28.6 m; to the right is a barrier.
TEST_F(TriggerCase, TellsWhatEveryPolicyHarmsWhereOneSideAloneIsFree) {
  const memory::Case one = of(only_left_helps()).value().value();
  EXPECT_FALSE(memory::broken_rule(one).has_value());
  EXPECT_EQ(one.origin, memory::Origin::simulation);
  EXPECT_EQ(one.source, "standing_car");
  ASSERT_FALSE(one.made_with.empty());
  EXPECT_EQ(one.made_with[0].what, "car");
  EXPECT_EQ(one.made_with[0].digest.size(), 16U);
  // 28.6 m from front to rear at 22 m/s is 1.3 s.
  const world::Scene& scene = one.scene;
  ASSERT_EQ(scene.actors.size(), 1U);
  EXPECT_NEAR(norm(scene.actors[0].X_WA.p - scene.ego.X_WB.p) - 2.25 - 2.25, 1.3 * 22.0, 0.3);
  ASSERT_EQ(one.intentions.size(), 1U);
  EXPECT_EQ(one.intentions[0][0], 1.0) << "who stands maintains";
  for (const auto* harms : {&one.told, &one.happened}) {
    ASSERT_TRUE(harms->has_value());
    const memory::PolicyHarms& all = **harms;
    EXPECT_GT(all[index(PolicyId::aeb)].value(), 0.01);
    EXPECT_GT(all[index(PolicyId::no_intervention)].value(), all[index(PolicyId::aeb)].value());
    EXPECT_NEAR(all[index(PolicyId::es_b_left)].value(), 0.0, 1e-4);
  }
  EXPECT_EQ(manoeuvre::side(one.best), 1);
  EXPECT_EQ(one.best_harm, one.happened->at(index(one.best)));
}

// Nothing is uncertain here but what 16 draws leave to the errors of a perfect perception: what was
// told of the straight ones is what happens.
TEST_F(TriggerCase, WasToldWhatHappensWhereNothingIsUnknown) {
  const memory::Case one = of(only_left_helps()).value().value();
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::no_intervention}) {
    EXPECT_NEAR(one.told->at(index(policy)).value(), one.happened->at(index(policy)).value(),
                0.1 * one.happened->at(index(policy)).value());
  }
}

// At 20 m/s 100 m are 5 s, of which T1 leaves 1.3.
TEST_F(TriggerCase, IsPlayedUntilTheTriggerFires) {
  const scenario::Scenario scenario = standing_car(20.0, 100.0);
  const encounter::Stage stage{&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}};
  const auto now = played_to_trigger(stage);
  ASSERT_TRUE(now.has_value() && now.value().has_value());
  EXPECT_NEAR(now.value()->time(), 3.7, 0.05);
  EXPECT_TRUE(now.value()->driven());
}

TEST_F(TriggerCase, IsNoneWhereNothingThreatens) {
  scenario::Scenario free = standing_car(20.0, 60.0);
  free.actors.clear();
  EXPECT_FALSE(of(free).value().has_value());
  scenario::Scenario aside = standing_car(20.0, 60.0);
  std::get<scenario::Script>(aside.actors[0].motion).start.d = 8.0;
  EXPECT_FALSE(of(aside).value().has_value());
}

}  // namespace
}  // namespace saca::eval::trigger_case_test
