#include "saca/runtime/planes.h"

#include <gmock/gmock.h>

#include "saca/intent/shipped_model.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/reason/scripted_model.h"
#include "tests/support/scenes.h"

namespace saca::runtime::planes_test {
namespace {

using manoeuvre::PolicyId;

/// 20 m/s on a wet road towards a wreck: braking at T1 is not enough, changing lanes is.
class PlanesTest : public testing::Test {
 protected:
  [[nodiscard]] static world::Scene at(double time) {
    world::Scene scene = test::ego_at(20.0);
    scene.time = time;
    scene.grip = 0.5;
    scene.ego.X_WB.p.x = 20.0 * time;
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -5.25;
    scene.actors.push_back(test::car(1, {90.0, 0.0}));
    return scene;
  }
  [[nodiscard]] PlanesSetup setup(reason::LanguageModel* model, decide::Guard guard) {
    return {.forecast = {&car_, &harm_},
            .costs = {.preview = 0.05, .prompt_token = 0.001, .reply_token = 0.01},
            .model = model,
            .guard = guard,
            .clock = &clock_};
  }
  /// The decision at the trigger.
  [[nodiscard]] decide::Decision decided(reason::LanguageModel* model, decide::Guard guard) {
    return decided(setup(model, guard));
  }
  [[nodiscard]] static decide::Decision decided(const PlanesSetup& setup) {
    Planes planes(setup, {}, 500);
    for (int k = 0; k < 450; ++k) {
      const world::Scene scene = at(0.01 * k);
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      if (planes.step(scene, beliefs, Clock::Time{0}, false).triggered) {
        break;
      }
    }
    return planes.decision().value();
  }
  static reason::ScriptedReply says(PolicyId policy) {
    return {.lines = {{.text = "because", .answer = reason::Answer::Kind::first, .policy = policy}},
            .prompt_tokens = 10,
            .reply_tokens = 5};
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = manoeuvre::default_car();
  outcome::HarmModel harm_ = outcome::read_harm("data/harm.toml").value();
};

// Braking needs 42.7 m and hits the wreck; both other lanes are free.
TEST_F(PlanesTest, WithoutModelAndMemoryTheVerdictDecides) {
  const auto decision = decided(nullptr, decide::Guard::never_worse_than_braking);
  EXPECT_TRUE(manoeuvre::changes_lane(decision.plan.policy)) << name(decision.plan.policy);
  EXPECT_EQ(decision.source, decide::Source::arbiter);
  ASSERT_TRUE(decision.verdict.has_value());
  EXPECT_LE(decision.time - decision.verdict->time, decide::verdict_expiry);
  EXPECT_FALSE(decision.by_atlas);
}

TEST_F(PlanesTest, ByThePapersRuleBrakingIsAllThereIsWithoutModelAndMemory) {
  const auto decision = decided(nullptr, decide::Guard::none);
  EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
  EXPECT_EQ(decision.source, decide::Source::fallback);
}

TEST_F(PlanesTest, AGoodAnswerIsCarriedOutUnderEitherRule) {
  for (const auto guard : {decide::Guard::never_worse_than_braking, decide::Guard::none}) {
    reason::ScriptedModel model(says(PolicyId::aes_left), clock_);
    const auto decision = decided(&model, guard);
    EXPECT_EQ(decision.plan.policy, PolicyId::aes_left);
    EXPECT_EQ(decision.source, decide::Source::model);
  }
}

// Doing nothing drives into the wreck at 20 m/s; the paper's algorithm caches what the model says.
TEST_F(PlanesTest, ABadAnswerIsCarriedOutByThePapersRuleOnly) {
  reason::ScriptedModel guarded(says(PolicyId::no_intervention), clock_);
  EXPECT_NE(decided(&guarded, decide::Guard::never_worse_than_braking).plan.policy,
            PolicyId::no_intervention);
  reason::ScriptedModel paper(says(PolicyId::no_intervention), clock_);
  const auto decision = decided(&paper, decide::Guard::none);
  EXPECT_EQ(decision.plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(decision.source, decide::Source::model);
}

// A verdict that takes a second is of a scene that is gone: nobody waits for it.
TEST_F(PlanesTest, ASlowForecasterIsNotWaitedFor) {
  PlanesSetup slow = setup(nullptr, decide::Guard::never_worse_than_braking);
  slow.costs.verdict = 1.0;
  const auto decision = decided(slow);
  EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
  EXPECT_EQ(decision.source, decide::Source::fallback);
  EXPECT_EQ(decision.time, decided(nullptr, decide::Guard::never_worse_than_braking).time);
}

TEST_F(PlanesTest, WhatHasBegunAnewDecidesAgain) {
  Planes planes(setup(nullptr, decide::Guard::never_worse_than_braking), {}, 1'000);
  int decisions = 0;
  for (int encounter = 0; encounter < 2; ++encounter) {
    for (int k = 0; k < 330; ++k) {
      world::Scene scene = at(0.01 * k);
      scene.time += 10.0 * encounter;
      const auto beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
      decisions += planes.step(scene, beliefs, Clock::Time{0}, false).triggered ? 1 : 0;
    }
    EXPECT_FALSE(planes.previews().empty());
    planes.begin_anew();
    EXPECT_EQ(planes.decision(), std::nullopt);
  }
  EXPECT_EQ(decisions, 2);
}

TEST_F(PlanesTest, NothingIsToldOfTimesBeforeTheFirstStep) {
  const Planes planes(setup(nullptr, decide::Guard::never_worse_than_braking), {}, 10);
  EXPECT_EQ(planes.timing().calls, 0U);
  EXPECT_EQ(planes.decision(), std::nullopt);
}

}  // namespace
}  // namespace saca::runtime::planes_test
