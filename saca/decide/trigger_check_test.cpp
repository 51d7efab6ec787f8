#include "saca/decide/trigger_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saca/manoeuvre/atlas_for_test.h"
#include "saca/outcome/roll_out.h"
#include "tests/support/scenes.h"

namespace saca::decide::trigger_check_test {
namespace {

using manoeuvre::PolicyId;
using manoeuvre::small_atlas;
using manoeuvre::small_atlas_car;
using test::car;

const outcome::HarmModel& harm() {
  static const outcome::HarmModel model = outcome::read_harm("data/harm.toml").value();
  return model;
}

/// 12.5 m/s on a wide road.
world::Scene road() {
  world::Scene scene = manoeuvre::atlas_scene(12.5, 0.85, 3.5);
  scene.ego_mass = small_atlas_car().mass;
  return scene;
}

manoeuvre::Plan plan(PolicyId policy) {
  return manoeuvre::atlas_plan(policy, 12.5);
}

// Full dynamics against the same tracks are the reference: a wreck too near to stop.
TEST(TriggerCheck, SaysWhatFullDynamicsSay) {
  TriggerCheck check(small_atlas(), harm());
  world::Scene scene = road();
  scene.actors.push_back(car(1, {10.0, 0.0}, {0.0, 0.0}));
  const std::vector<world::Track> stands{{.X_WA = {scene.actors[0].X_WA}}};
  const auto told = check.compare(plan(PolicyId::aes_left), scene);
  ASSERT_TRUE(told.has_value());
  const auto rolled = [&](PolicyId policy) {
    return roll_out(small_atlas_car(), plan(policy), scene, stands, scene.grip, harm()).harm;
  };
  EXPECT_GT(rolled(PolicyId::aeb), 0.0);
  EXPECT_NEAR(told->aeb, rolled(PolicyId::aeb), 0.1 * rolled(PolicyId::aeb));
  EXPECT_GT(rolled(PolicyId::aes_left), rolled(PolicyId::aeb));  // too near for a swerve, too
  EXPECT_TRUE(told->plan_harms_more());
}

// Braking lets a near follower run into the ego; who does not react at all would do so as well when
// the ego just goes on more slowly, but a swerve leaves its way.
TEST(TriggerCheck, FollowersReactInBoth) {
  TriggerCheck check(small_atlas(), harm());
  world::Scene near = road();
  near.actors.push_back(car(1, {-8.0, 0.0}, {12.5, 0.0}));
  const auto pressed = check.compare(plan(PolicyId::aes_left), near);
  ASSERT_TRUE(pressed.has_value());
  EXPECT_GT(pressed->aeb, 0.0);
  EXPECT_EQ(pressed->plan, 0.0);
  // 60 m behind there is time for the usual 1.25 s and a firm stop.
  world::Scene far = road();
  far.actors.push_back(car(1, {-60.0, 0.0}, {12.5, 0.0}));
  EXPECT_EQ(check.compare(plan(PolicyId::aes_left), far)->aeb, 0.0);
}

// Who comes up from behind, 3 m/s faster and 10 m behind, has to brake also for who goes on: it
// does, so going on harms nobody.
TEST(TriggerCheck, FollowersReactToAPlanThatStaysInItsLane) {
  TriggerCheck check(small_atlas(), harm());
  world::Scene scene = road();
  scene.actors.push_back(car(1, {-15.0, 0.0}, {15.5, 0.0}));
  const auto told = check.compare(plan(PolicyId::no_intervention), scene);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->plan, 0.0);
  EXPECT_GT(told->aeb, 0.0);
}

// A lead that brakes with 6 m/s^2: going on hits it at 12.5 m/s less what it has left,
// 6 m/s^2 t with 12.5 t - (12.5 t - 3 t^2) = 8 m, so t = 1.63 s and 9.8 m/s.
TEST(TriggerCheck, KnowsHowFastWhoBrakesIs) {
  TriggerCheck check(small_atlas(), harm());
  world::Scene scene = road();
  const double front = support(scene.ego_footprint, {}, {1.0, 0.0}).x;
  scene.actors.push_back(car(1, {front + 8.0 + 2.25, 0.0}, {12.5, 0.0}));
  scene.actors[0].a_W = {-6.0, 0.0};
  world::Track brakes{.step = 0.001, .X_WA = {}};  // as fine as can be: the reference
  for (int k = 0; k <= 10'000; ++k) {
    const double t = std::min(k * brakes.step, 12.5 / 6.0);
    brakes.X_WA.push_back({scene.actors[0].X_WA.p + Vec2{12.5 * t - 3.0 * t * t, 0.0}, 0.0});
  }
  const manoeuvre::Plan on = plan(PolicyId::no_intervention);
  const std::vector<world::Track> tracks{brakes};
  const auto reference = roll_out(small_atlas_car(), on, scene, tracks, scene.grip, harm());
  ASSERT_TRUE(reference.contact.has_value());
  EXPECT_NEAR(reference.contact->relative_speed, 9.8, 0.3);
  EXPECT_NEAR(check.compare(on, scene)->plan, reference.harm, 0.03 * reference.harm);
}

TEST(TriggerCheck, DoesNotTellWhatTheAtlasDoesNotHave) {
  TriggerCheck check(small_atlas(), harm());
  world::Scene fast = road();
  fast.ego.v_B.x = 14.0;
  EXPECT_FALSE(check.compare(plan(PolicyId::aes_left), fast).has_value());
  EXPECT_TRUE(check.compare(plan(PolicyId::aes_left), road()).has_value());
}

// A class is a ten-thousandth of harm: less is no difference.
TEST(Comparison, CountsInClasses) {
  EXPECT_FALSE((Comparison{0.10001, 0.10002}.plan_harms_more()));
  EXPECT_FALSE((Comparison{0.10002, 0.10001}.plan_harms_more()));
  EXPECT_TRUE((Comparison{0.1003, 0.1}.plan_harms_more()));
  EXPECT_FALSE((Comparison{0.1, 0.1003}.plan_harms_more()));
}

}  // namespace
}  // namespace saca::decide::trigger_check_test
