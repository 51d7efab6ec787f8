#include "saca/lab/eval/judged_encounter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::judged_encounter_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;

class Judging : public testing::Test {
 protected:
  [[nodiscard]] Result<std::optional<JudgedEncounter>> of(const scenario::Scenario& scenario,
                                                          int draws = 6) const {
    return judged_encounter(
        {&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}}, {&car_, &harm_},
        {.told_draws = 16, .draws = draws, .seed = 7},
        encounter::made_with({&car_, &harm_}, intent::shipped_model(), "a car"));
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

// Braking needs 49 m and has 28.6 m; to the right is a barrier: the left is best in every draw.
TEST_F(Judging, TellsTheBestOverDrawsAndWhatIsAdmissible) {
  const JudgedEncounter judged = of(only_left_helps()).value().value();
  EXPECT_FALSE(memory::broken_rule(judged.one).has_value());
  EXPECT_EQ(judged.one.draws, 6);
  EXPECT_EQ(manoeuvre::side(judged.one.best), 1);
  EXPECT_EQ(judged.one.best_harm, judged.one.happened->at(index(judged.one.best)));
  for (const auto& policy : judged.happened) {
    if (policy) {
      EXPECT_LE(policy->harm.low, policy->harm.value);
      EXPECT_GE(policy->harm.high, policy->harm.value);
    }
  }
  EXPECT_EQ(judged.happened[index(PolicyId::no_intervention)]->contact, 1.0);
  EXPECT_GT(judged.happened[index(PolicyId::aeb)]->harm.value, 0.01);
}

// Recorded at 15 m/s towards a car that stands 60 m ahead; 1.3 s before it, braking with 4 m/s2.
TEST_F(Judging, SaysWhatARecordedDriverDid) {
  scenario::Scenario scenario = standing_car(15.0, 60.0);
  EXPECT_EQ(of(scenario).value()->driver, std::nullopt) << "nobody was recorded";
  constexpr double begun = 2.7;  // [s]
  scenario::Recording ego;
  for (int k = 0; k <= 80; ++k) {
    const double time = 0.1 * k;
    const double braked = std::clamp(time - begun, 0.0, 15.0 / 4.0);
    ego.push_back(
        {.time = time,
         .X_WA = {{15.0 * std::min(time, begun) + 15.0 * braked - 2.0 * braked * braked, 0.0}, 0.0},
         .speed = 15.0 - 4.0 * braked});
  }
  scenario.ego = ego;
  EXPECT_EQ(of(scenario).value()->driver, PolicyId::aeb);
}

// By definition: expected harm at most that limit.
TEST_F(Judging, AdmissibleIsWhatIsExpectedToHarmAsLittleAsTheBest) {
  const JudgedEncounter judged = of(only_left_helps()).value().value();
  ASSERT_TRUE(judged.admissible_harm.has_value());
  int admissible = 0;
  for (const VerdictPlan& plan : judged.plans) {
    EXPECT_EQ(plan.admissible, plan.harm <= *judged.admissible_harm) << plan.harm;
    admissible += plan.admissible ? 1 : 0;
    if (plan.plan.policy == PolicyId::no_intervention) {
      EXPECT_FALSE(plan.admissible);
    }
  }
  EXPECT_GT(admissible, 0);
  EXPECT_EQ(manoeuvre::side(judged.speaks_for.policy), 1);
}

TEST_F(Judging, SameSeedSameNumbers) {
  const JudgedEncounter one = of(only_left_helps()).value().value();
  const JudgedEncounter again = of(only_left_helps()).value().value();
  EXPECT_EQ(one.one.happened, again.one.happened);
  EXPECT_EQ(one.one.told, again.one.told);
}

TEST_F(Judging, IsNoneWhereNothingThreatens) {
  scenario::Scenario free = standing_car(20.0, 60.0);
  free.actors.clear();
  EXPECT_FALSE(of(free).value().has_value());
  EXPECT_FALSE(trigger_as_written(free, car_, harm_).has_value());
}

// 1.3 s before the car that stands: at its rear, with our front, at our speed.
TEST_F(Judging, WithoutAvoidanceTheOneAheadIsMet) {
  const auto as_written = trigger_as_written(standing_car(20.0, 100.0), car_, harm_);
  ASSERT_TRUE(as_written.has_value() && as_written->contact.has_value());
  const WithoutAvoidance& contact = *as_written->contact;
  EXPECT_TRUE(contact.first_actor);
  EXPECT_EQ(contact.met, "car1");
  EXPECT_EQ(contact.ego_face, collision::Face::front);
  EXPECT_EQ(contact.other_face, collision::Face::rear);
  EXPECT_NEAR(contact.relative_speed, 20.0, 0.2);
  EXPECT_NEAR(contact.after, 1.3, 0.05);
  EXPECT_NEAR(as_written->time, 5.0 - 1.3, 0.05);
}

}  // namespace
}  // namespace saca::eval::judged_encounter_test
