#include "saca/lab/encounter/hindsight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/runtime/wreck_for_test.h"

namespace saca::encounter::hindsight_test {
namespace {

using manoeuvre::PolicyId;

// A wreck 28 m ahead of the front at 20 m/s, lanes on both sides. Braking takes 24.9 m on dry road
// and 42.7 m at grip 0.5 (docs/architecture.md); a lane change 0.9 s to clear it.
TEST(Hindsight, KnowsWhatEachPolicyWouldHaveDone) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  world::Scene scene = runtime::wreck_ahead(car, 32.5);
  scene.road.left_edge = 5.25;
  scene.road.right_edge = -5.25;
  scene.grip = 0.5;
  const collision::Others stands = [&](const manoeuvre::EgoMotion&) {
    return std::vector<world::Track>{{.X_WA = {scene.actors[0].X_WA}}};
  };

  const auto try_all = [&](double grip) {
    return hindsight(
        DecisionPoint{.scene = scene, .others = stands, .grip = grip, .perturbation = {}}, car,
        harm);
  };
  const Hindsights all = try_all(0.5);
  const auto of = [&](PolicyId policy) -> const Hindsight& {
    return all[manoeuvre::index(policy)];
  };
  EXPECT_TRUE(of(PolicyId::aeb).facts.outcome().contact.has_value());
  EXPECT_GT(of(PolicyId::no_intervention).facts.outcome().harm,
            of(PolicyId::aeb).facts.outcome().harm);
  EXPECT_FALSE(of(PolicyId::aes_left).facts.outcome().contact.has_value());
  // Whoever hits the wreck slides to rest behind it.
  const Hindsight& nothing = of(PolicyId::no_intervention);
  EXPECT_GT(world::end_time(nothing.sequence.ego.track), nothing.facts.outcome().contact->time);
  EXPECT_LT(norm(nothing.sequence.ego.v_B.back()), 0.1);
  // What was carried out is tried as it was.
  const DecisionPoint slowly{.scene = scene,
                             .others = stands,
                             .grip = 0.5,
                             .perturbation = {},
                             .carried_out = manoeuvre::Plan{PolicyId::es_b_left, 15.0}};
  const Hindsights tried = hindsight(slowly, car, harm);
  EXPECT_EQ(tried[manoeuvre::index(PolicyId::es_b_left)].facts.plan.target_speed, 15.0);
  EXPECT_EQ(tried[manoeuvre::index(PolicyId::es_b_right)].facts.plan.target_speed, 10.0);
  // On dry road braking would have been enough.
  scene.grip = 0.9;
  EXPECT_FALSE(try_all(0.9)[manoeuvre::index(PolicyId::aeb)].facts.outcome().contact.has_value());
  // A drift cannot be driven where the road is slippery enough.
  scene.grip = 0.15;
  const auto slippery = try_all(0.15);
  const Hindsight& drift = slippery[manoeuvre::index(PolicyId::t_drift_left)];
  EXPECT_TRUE(drift.sequence.ego.track.X_WA.empty());
  EXPECT_FALSE(drift.facts.drivable());
}

// The same wreck between barriers: whatever is done, something is met.
TEST(Hindsight, OfEachPolicyThePlanStandsThatHarmsLeast) {
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  world::Scene scene = runtime::wreck_ahead(car, 32.5);
  scene.road.left_edge = 1.9;
  scene.road.right_edge = -1.9;
  scene.road.left_beyond = world::Beyond::barrier;
  scene.road.right_beyond = world::Beyond::barrier;
  scene.grip = 0.5;
  const collision::Others stands = [&](const manoeuvre::EgoMotion&) {
    return std::vector<world::Track>{{.X_WA = {scene.actors[0].X_WA}}};
  };
  const DecisionPoint point{.scene = scene, .others = stands, .grip = 0.5, .perturbation = {}};
  const auto all = all_plans_tried({&point, 1}, car, harm).front();
  EXPECT_EQ(all.size(), forecast::all_plans(norm(scene.ego.v_B)).size());
  const Hindsights best = hindsight_of_all_speeds(point, car, harm);
  bool other_than_default = false;
  for (const Hindsight& one : all) {
    const Hindsight& of_policy = best[manoeuvre::index(one.facts.plan.policy)];
    EXPECT_EQ(of_policy.facts.plan.policy, one.facts.plan.policy);
    if (one.facts.drivable() && !manoeuvre::takes_strength(one.facts.plan.policy)) {
      EXPECT_LE(of_policy.facts.outcome().harm, one.facts.outcome().harm + collision::harm_tie);
    }
    other_than_default =
        other_than_default ||
        of_policy.facts.plan != manoeuvre::default_plan(one.facts.plan.policy, norm(scene.ego.v_B));
  }
  EXPECT_EQ(best[manoeuvre::index(PolicyId::aeb)].facts.plan,
            (manoeuvre::Plan{PolicyId::aeb, std::nullopt}));
  EXPECT_TRUE(other_than_default);  // a barrier is met more slowly at another target speed
  // What was carried out is one of them, and stays where nothing harms less.
  const manoeuvre::Plan lone{PolicyId::no_intervention, std::nullopt};
  EXPECT_EQ(best[manoeuvre::index(PolicyId::no_intervention)].facts.plan, lone);
  const DecisionPoint slowly{.scene = scene,
                             .others = stands,
                             .grip = 0.5,
                             .perturbation = {},
                             .carried_out = manoeuvre::Plan{PolicyId::aeb, std::nullopt, 0.93}};
  const auto with_it = all_plans_tried({&slowly, 1}, car, harm).front();
  EXPECT_EQ(with_it.size(), all.size());
  EXPECT_EQ(std::count_if(with_it.begin(), with_it.end(),
                          [](const Hindsight& one) { return one.facts.plan.strength == 0.93; }),
            1);
}

}  // namespace
}  // namespace saca::encounter::hindsight_test
