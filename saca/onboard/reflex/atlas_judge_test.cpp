#include "saca/onboard/reflex/atlas_judge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/rollout/roll_out.h"
#include "tests/support/scenes.h"

namespace saca::reflex::atlas_judge_test {
namespace {

using atlas::small_atlas;
using atlas::small_atlas_car;
using manoeuvre::PolicyId;
using test::car;

const collision::HarmModel& harm() {
  static const collision::HarmModel model = prepare::read_harm("data/harm.toml").value();
  return model;
}

/// 12.5 m/s on a wide road.
world::Scene road() {
  world::Scene scene = atlas::atlas_scene(12.5, 0.85, 3.5);
  scene.ego_mass = small_atlas_car().mass;
  return scene;
}

manoeuvre::Plan plan(PolicyId policy) {
  return atlas::atlas_plan(policy, 12.5);
}

/// What the verdict says that a policy harms.
double told(AtlasJudge& judge, PolicyId policy, const world::Scene& scene) {
  const auto verdict = judge.judge(scene);
  const JudgedPlan* const judged = verdict ? find_plan(*verdict, plan(policy)) : nullptr;
  EXPECT_TRUE(judged != nullptr && judged->drivable);
  return judged == nullptr ? -1.0 : judged->harm;
}

// Full dynamics against the same tracks are the reference: a wreck too near to stop.
TEST(AtlasJudge, SaysWhatFullDynamicsSay) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene scene = road();
  scene.actors.push_back(car(1, {10.0, 0.0}, {0.0, 0.0}));
  const std::vector<world::Track> stands{{.X_WA = {scene.actors[0].X_WA}}};
  const auto rolled = [&](PolicyId policy) {
    return rollout::roll_out(small_atlas_car(), plan(policy), scene, stands, scene.grip, harm())
        .harm;
  };
  EXPECT_GT(rolled(PolicyId::aeb), 0.0);
  const double aeb = told(judge, PolicyId::aeb, scene);
  EXPECT_NEAR(aeb, rolled(PolicyId::aeb), 0.1 * rolled(PolicyId::aeb));
  EXPECT_GT(rolled(PolicyId::aes_left), rolled(PolicyId::aeb));  // too near for a swerve, too
  EXPECT_GT(told(judge, PolicyId::aes_left, scene), aeb);
}

// Braking lets a near follower run into the ego; who does not react at all would do so as well when
// the ego just goes on more slowly, but a swerve leaves its way.
TEST(AtlasJudge, FollowersReactInBoth) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene near = road();
  near.actors.push_back(car(1, {-8.0, 0.0}, {12.5, 0.0}));
  EXPECT_GT(told(judge, PolicyId::aeb, near), 0.0);
  EXPECT_EQ(told(judge, PolicyId::aes_left, near), 0.0);
  // 60 m behind there is time for the usual 1.25 s and a firm stop.
  world::Scene far = road();
  far.actors.push_back(car(1, {-60.0, 0.0}, {12.5, 0.0}));
  EXPECT_EQ(told(judge, PolicyId::aeb, far), 0.0);
}

// Its speed may be perceived wrongly by 0.5 m/s, 5 m in the 10 s that are looked at: it sees the
// gap and keeps it. Its place is what it is seen to be.
TEST(AtlasJudge, WhoReactsIsAsUnsureAsItsPlaceIsPerceived) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene scene = road();
  scene.actors.push_back(car(1, {-60.0, 0.0}, {12.5, 0.0}));
  const auto contact = [&](double place_sd, double speed_sd) {
    scene.actors[0].position_sd = place_sd;
    scene.actors[0].velocity_sd = speed_sd;
    const auto verdict = judge.judge(scene);
    return verdict ? find_plan(*verdict, manoeuvre::full_braking)->contact : -1.0;
  };
  EXPECT_EQ(contact(0.1, 0.0), 0.0);
  EXPECT_EQ(contact(0.1, 0.5), 0.0);
  EXPECT_GT(contact(3.0, 0.0), 0.0);
  EXPECT_EQ(contact(3.0, 0.5), contact(3.0, 0.0));
}

// Who comes up from behind, 3 m/s faster and 10 m behind, has to brake also for who goes on: it
// does, so going on harms nobody.
TEST(AtlasJudge, FollowersReactToAPlanThatStaysInItsLane) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene scene = road();
  scene.actors.push_back(car(1, {-15.0, 0.0}, {15.5, 0.0}));
  EXPECT_EQ(told(judge, PolicyId::no_intervention, scene), 0.0);
  EXPECT_GT(told(judge, PolicyId::aeb, scene), 0.0);
}

// A lead that brakes with 6 m/s^2: going on hits it at 12.5 m/s less what it has left,
// 6 m/s^2 t with 12.5 t - (12.5 t - 3 t^2) = 8 m, so t = 1.63 s and 9.8 m/s.
TEST(AtlasJudge, KnowsHowFastWhoBrakesIs) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
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
  const auto reference =
      rollout::roll_out(small_atlas_car(), on, scene, tracks, scene.grip, harm());
  ASSERT_TRUE(reference.contact.has_value());
  EXPECT_NEAR(reference.contact->relative_speed, 9.8, 0.3);
  EXPECT_NEAR(told(judge, on.policy, scene), reference.harm, 0.03 * reference.harm);
}

TEST(AtlasJudge, DoesNotTellWhatTheAtlasDoesNotHave) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene fast = road();
  fast.ego.v_B.x = 14.0;
  EXPECT_FALSE(judge.judge(fast).has_value());
  EXPECT_TRUE(judge.judge(road()).has_value());
}

TEST(AtlasJudge, TellsWhatCannotBeDriven) {
  AtlasJudge judge(small_atlas_car(), small_atlas(), harm());
  world::Scene scene = road();
  scene.road.lane_width = 7.0;  // wider than any lane change is made for
  const auto verdict = judge.judge(scene);
  ASSERT_TRUE(verdict.has_value());
  EXPECT_FALSE(find_plan(*verdict, plan(PolicyId::aes_left))->drivable);
  EXPECT_TRUE(find_plan(*verdict, plan(PolicyId::aeb))->drivable);
}

}  // namespace
}  // namespace saca::reflex::atlas_judge_test
