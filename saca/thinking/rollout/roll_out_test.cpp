#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "saca/thinking/rollout/encounters_for_test.h"
#include "saca/thinking/rollout/roll_out.h"

namespace saca::rollout::roll_out_test {
namespace {

using manoeuvre::PolicyId;
using world::ActorKind;

const manoeuvre::Car& car() {
  static const manoeuvre::Car it = prepare::default_car();
  return it;
}

// A wreck stands `gap` ahead of the ego's bumper; the next lane is to the left.
struct Ahead {
  world::Scene scene = empty_scene();
  std::vector<world::Track> tracks;

  Ahead(double speed, double gap) {
    scene.ego.v_B = {speed, 0.0};
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -1.75;
    world::Actor wreck;
    wreck.kind = ActorKind::obstacle;
    wreck.footprint = {.length = 2.0, .width = 2.1};
    wreck.mass = 1000.0;
    wreck.X_WA = {{2.35 + gap + 1.0, 0.0}, 0.0};
    scene.actors.push_back(wreck);
    tracks.push_back({.start = 0.0, .step = 0.01, .X_WA = {wreck.X_WA}});
  }
  [[nodiscard]] collision::Outcome after(PolicyId policy, double grip) const {
    const manoeuvre::Plan plan = manoeuvre::default_plan(policy, norm(scene.ego.v_B));
    return roll_out(car(), plan, scene, tracks, grip, shipped_harm());
  }
};

// Braking from 14 m/s takes 12.70 m (-3 / +12 %) at grip 0.9, 21.52 m at 0.5: the design's table of
// stopping distances, from an independent vehicle model.
TEST(RollOut, BrakingStopsWhereTheStoppingDistanceSays) {
  const collision::Outcome dry = Ahead(14.0, 20.0).after(PolicyId::aeb, 0.9);
  EXPECT_FALSE(dry.contact);
  EXPECT_EQ(dry.harm, 0.0);
  EXPECT_GT(dry.clearance, 20.0 - 1.12 * 12.70);
  EXPECT_LT(dry.clearance, 20.0 - 0.97 * 12.70);
  const collision::Outcome wet = Ahead(14.0, 20.0).after(PolicyId::aeb, 0.5);
  ASSERT_TRUE(wet.contact);
  EXPECT_EQ(wet.contact->ego_face, collision::Face::front);
}

// Nothing done, nothing lost but to drag: 20 m at close to 14 m/s.
TEST(RollOut, GoingOnMeetsTheWreckAtSpeed) {
  const collision::Outcome outcome = Ahead(14.0, 20.0).after(PolicyId::no_intervention, 0.9);
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->time, 20.0 / 14.0, 0.03);
  EXPECT_NEAR(outcome.contact->relative_speed, 14.0, 0.3);
  EXPECT_NEAR(outcome.collision_loss, 0.35 * outcome.contact->relative_speed, 1e-9);
}

// Too near to stop: after 10 of 12.70 m, v^2 = 14^2 (1 - 10 / 12.70) if it fell evenly; the brakes
// build up first, so a little more.
TEST(RollOut, BrakingTooLateStillTakesSpeedAndHarmOff) {
  const Ahead near(14.0, 10.0);
  const collision::Outcome braked = near.after(PolicyId::aeb, 0.9);
  const collision::Outcome not_braked = near.after(PolicyId::no_intervention, 0.9);
  ASSERT_TRUE(braked.contact && not_braked.contact);
  const double evenly = 14.0 * std::sqrt(1.0 - 10.0 / 12.70);
  EXPECT_GT(braked.contact->relative_speed, evenly - 0.3);
  EXPECT_LT(braked.contact->relative_speed, evenly + 1.2);
  EXPECT_TRUE(better(braked, PolicyId::aeb, not_braked, PolicyId::no_intervention));
  EXPECT_LT(braked.harm, not_braked.harm);
}

TEST(RollOut, ALaneChangePassesTheWreck) {
  const collision::Outcome outcome = Ahead(14.0, 35.0).after(PolicyId::aes_left, 0.9);
  EXPECT_FALSE(outcome.contact);
  // It passes 3.5 m aside, which leaves 3.5 - 0.95 - 1.05, up to how well the lane is met.
  EXPECT_NEAR(outcome.clearance, 1.5, 0.2);
}

TEST(RollOut, RefusesWhatCannotBeDriven) {
  EXPECT_THROW((void)Ahead(9.0, 20.0).after(PolicyId::t_drift_left, 0.9), ContractViolation);
}

// The reference is `roll_out`, one at a time; the batch ends within centimetres of it.
TEST(RollOutAll, IsRollOutWithinCentimetres) {
  std::vector<Ahead> scenes;
  for (const double speed : {8.0, 14.0, 22.0}) {
    for (const double gap : {9.0, 20.0, 45.0}) {
      scenes.emplace_back(speed, gap);
    }
  }
  std::vector<collision::Others> others;
  for (const Ahead& ahead : scenes) {
    others.emplace_back([&ahead](const manoeuvre::EgoMotion&) { return ahead.tracks; });
  }
  std::vector<Attempt> attempts;
  std::vector<collision::Outcome> wanted;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const PolicyId policy : manoeuvre::all_policies) {
      const auto plan = manoeuvre::default_plan(policy, scenes[i].scene.ego.v_B.x);
      if (!manoeuvre::refusal(car(), plan, scenes[i].scene)) {
        attempts.push_back({plan, &scenes[i].scene, &others[i], 0.8, {}});
        wanted.push_back(scenes[i].after(policy, 0.8));
      }
    }
  }
  const std::vector<CollisionSequence> got = roll_out_all(car(), attempts, shipped_harm());
  const std::vector<CollisionSequence> on_two = roll_out_all(car(), attempts, shipped_harm(), 2);
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t k = 0; k < got.size(); ++k) {
    const collision::Outcome& outcome = got[k].outcome;
    const std::string_view policy = manoeuvre::name(attempts[k].plan.policy);
    ASSERT_EQ(outcome.contact.has_value(), wanted[k].contact.has_value()) << policy;
    EXPECT_NEAR(outcome.clearance, wanted[k].clearance, 0.05) << policy;
    EXPECT_NEAR(outcome.end_time, wanted[k].end_time, 0.03) << policy;
    if (outcome.contact) {
      EXPECT_NEAR(outcome.contact->relative_speed, wanted[k].contact->relative_speed, 0.05)
          << policy;
      EXPECT_EQ(outcome.contact->ego_face, wanted[k].contact->ego_face) << policy;
    }
    EXPECT_EQ(outcome.harm, on_two[k].outcome.harm) << policy;
    EXPECT_EQ(outcome.clearance, on_two[k].outcome.clearance) << policy;
  }
}

TEST(RollOutAll, RefusesWhatCannotBeDriven) {
  const Ahead ahead(9.0, 20.0);
  const collision::Others others = [&](const manoeuvre::EgoMotion&) { return ahead.tracks; };
  const std::vector<Attempt> drift{{{PolicyId::t_drift_left, {}}, &ahead.scene, &others, 0.9, {}}};
  EXPECT_THROW((void)roll_out_all(car(), drift, shipped_harm()), ContractViolation);
  const std::vector<Attempt> nowhere{{{PolicyId::aeb, {}}, nullptr, &others, 0.9, {}}};
  EXPECT_THROW((void)roll_out_all(car(), nowhere, shipped_harm()), ContractViolation);
  EXPECT_TRUE(roll_out_all(car(), {}, shipped_harm()).empty());
}

}  // namespace
}  // namespace saca::rollout::roll_out_test
