#include "saca/lab/eval/trigger_choices.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/trigger_case.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::eval::trigger_choices_test {
namespace {

/// At T1, a car stands where braking does not help and the left alone is free.
class TriggerChoicesTest : public testing::Test {
 protected:
  [[nodiscard]] MethodTools tools(std::uint64_t seed) const {
    return {
        .saca = {.forecast = {&car_, &harm_}}, .intent = &intent::shipped_model(), .seed = seed};
  }
  encounter::Action chosen(std::string_view name, std::uint64_t seed = 1) {
    const encounter::Stage stage{&scenario_, &car_, &harm_, &intent::shipped_model(), {}, {}};
    const auto truth = played_to_trigger(stage);
    EXPECT_TRUE(truth.has_value() && truth.value());
    reflex::ActorSet everybody;
    everybody.set();
    const encounter::View view{.scene = truth.value()->seen(),
                               .beliefs = truth.value()->beliefs(),
                               .confirmed = everybody,
                               .driven = true,
                               .truth = *truth.value()};
    return trigger_choice(name, tools(seed))(view);
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
  scenario::Scenario scenario_ = only_left_helps();
};

TEST_F(TriggerChoicesTest, AebIsFullBraking) {
  EXPECT_EQ(chosen("aeb").plan, manoeuvre::full_braking);
}

TEST_F(TriggerChoicesTest, ByChanceEveryPolicyComesAndAlwaysTheSameOfASeed) {
  std::set<manoeuvre::PolicyId> all;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    all.insert(chosen("random", seed).plan.policy);
    EXPECT_EQ(chosen("random", seed).plan, chosen("random", seed).plan);
  }
  EXPECT_EQ(all.size(), manoeuvre::num_policies);
}

TEST_F(TriggerChoicesTest, WhoSeesThatOneSideAloneIsFreeGoesThere) {
  EXPECT_EQ(manoeuvre::side(chosen("beliefs_rolled_out").plan.policy), 1);
  EXPECT_EQ(manoeuvre::side(chosen("true_rolled_out").plan.policy), 1);
}

// They decide at other instants, or never.
TEST_F(TriggerChoicesTest, OfOtherKindsThereIsNone) {
  for (const std::string_view name : {"saca", "saca_paper", "nothing", "rss", "first_forecast"}) {
    EXPECT_EQ(trigger_choice(name, tools(1)), nullptr) << name;
  }
}

}  // namespace
}  // namespace saca::eval::trigger_choices_test
