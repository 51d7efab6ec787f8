#include "saca/thinking/preview/supposed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "tests/support/scenes.h"

namespace saca::preview::supposed_test {
namespace {

using intent::CueLaw;
using intent::Unseen;
using world::ActorKind;
using world::CueKind;
using world::Scene;

CueLaw law() {
  CueLaw law;
  law.unseen[static_cast<std::size_t>(CueKind::bus_at_stop)] =
      Unseen{.who = ActorKind::pedestrian, .probability = 0.3, .speed = 2.0};
  law.unseen[static_cast<std::size_t>(CueKind::wet_leaves)] =
      Unseen{.who = std::nullopt, .probability = 0.9, .grip_share = 0.5};
  return law;
}

/// 10 m/s, the front at the origin of the lane.
Scene road(CueKind kind, double ahead, double left) {
  Scene scene = test::ego_at(10.0);
  const double front = scene.ego_footprint.centre_x + 0.5 * scene.ego_footprint.length;
  scene.ego.X_WB.p = {-front, 0.0};
  scene.cues.push_back({kind, {ahead, left}});
  return scene;
}

// 20 m ahead of 10 m/s are 2 s; at 2 m/s somebody who then is half-way between the cue and the
// middle, 1.5 m to the right, is 5.5 m to the right now. What is even over 3 m has a standard
// deviation of 3 / sqrt(12).
TEST(Suppositions, SomebodyMeetsTheEgoWhereItGoesOn) {
  const Scene scene = road(CueKind::bus_at_stop, 20.0, -3.0);
  const Suppositions all = suppositions(scene, {}, law());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_DOUBLE_EQ(all[0].probability, 0.3);
  EXPECT_FALSE(all[0].is_slippery);
  ASSERT_EQ(all[0].scene.actors.size(), 1U);
  ASSERT_EQ(all[0].beliefs.size(), 1U);
  const world::Actor& he = all[0].scene.actors[0];
  EXPECT_EQ(he.kind, ActorKind::pedestrian);
  EXPECT_NEAR(he.X_WA.p.x, 20.0, 1e-12);
  EXPECT_NEAR(he.X_WA.p.y, -5.5, 1e-12);
  EXPECT_NEAR(he.position_sd, 3.0 / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(he.v_W.x, 0.0, 1e-12);
  EXPECT_NEAR(he.v_W.y, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(he.existence, 1.0);
  EXPECT_TRUE(he.occluded);
  EXPECT_FALSE(world::broken_rule(all[0].scene));
}

TEST(Suppositions, TheOtherSideIsTheMirrorImage) {
  const Suppositions right = suppositions(road(CueKind::bus_at_stop, 20.0, -3.0), {}, law());
  const Suppositions left = suppositions(road(CueKind::bus_at_stop, 20.0, 3.0), {}, law());
  const world::Actor& from_right = right[0].scene.actors[0];
  const world::Actor& from_left = left[0].scene.actors[0];
  EXPECT_NEAR(from_left.X_WA.p.y, -from_right.X_WA.p.y, 1e-12);
  EXPECT_NEAR(from_left.v_W.y, -from_right.v_W.y, 1e-12);
}

TEST(Suppositions, NobodyIsSupposedBehindOrFarAhead) {
  for (const double ahead : {-0.1, 40.1, 1e4}) {
    EXPECT_TRUE(suppositions(road(CueKind::bus_at_stop, ahead, -3.0), {}, law()).empty()) << ahead;
  }
  // Of which the law says nothing.
  EXPECT_TRUE(suppositions(road(CueKind::low_sun, 20.0, -3.0), {}, law()).empty());
  Scene standing = road(CueKind::bus_at_stop, 20.0, -3.0);
  standing.ego.v_B = {};
  EXPECT_TRUE(suppositions(standing, {}, law()).empty());
}

// A child runs out between the vans: nobody supposes another.
TEST(Suppositions, NobodyIsSupposedBesidesWhoIsSeen) {
  Scene scene = road(CueKind::bus_at_stop, 20.0, -3.0);
  world::Actor child = test::car(1, {20.0, -3.0});
  child.kind = ActorKind::pedestrian;
  child.X_WA.yaw = 1.5;
  child.v_W = {0.0, 2.0};
  scene.actors.push_back(child);
  intent::Beliefs one;
  one.push_back({});
  EXPECT_TRUE(suppositions(scene, one, law()).empty());
  scene.actors[0].v_W = {0.0, 0.4};  // who stands, as perceived
  EXPECT_EQ(suppositions(scene, one, law()).size(), 1U);
  scene.actors[0].v_W = {0.0, -2.0};  // who leaves the road
  EXPECT_EQ(suppositions(scene, one, law()).size(), 1U);
  scene.actors[0].v_W = {0.0, 2.0};
  scene.actors[0].X_WA.p.x += least_reach + seen_before * 2.0;
  EXPECT_EQ(suppositions(scene, one, law()).size(), 1U);
}

// Half a second before the ego is there he would be 1 m from where he is to be, in the lane: he
// would be seen.
TEST(Suppositions, NobodyIsSupposedWhoWouldBeSeen) {
  EXPECT_TRUE(suppositions(road(CueKind::bus_at_stop, 5.0, -3.0), {}, law()).empty());
  EXPECT_EQ(suppositions(road(CueKind::bus_at_stop, 8.0, -3.0), {}, law()).size(), 1U);
}

TEST(Suppositions, ItStaysSlipperyBehindTheCue) {
  EXPECT_EQ(suppositions(road(CueKind::wet_leaves, 1.0 - slippery_for, 0.0), {}, law()).size(), 1U);
  EXPECT_TRUE(suppositions(road(CueKind::wet_leaves, -1.0 - slippery_for, 0.0), {}, law()).empty());
}

TEST(Suppositions, TogetherTheyAreCapped) {
  Scene scene = road(CueKind::bus_at_stop, 20.0, -3.0);
  scene.cues.push_back({CueKind::wet_leaves, {10.0, 0.0}});
  const Suppositions all = suppositions(scene, {}, law());  // 0.3 and 0.9
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].probability, 0.3 / 1.2 * most_likely, 1e-12);
  EXPECT_NEAR(all[1].probability, 0.9 / 1.2 * most_likely, 1e-12);
}

TEST(Suppositions, WhereItIsSlipperyThereIsLessGrip) {
  Scene scene = road(CueKind::wet_leaves, 20.0, 0.0);
  scene.grip = 0.8;
  const Suppositions all = suppositions(scene, {}, law());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(all[0].is_slippery);
  EXPECT_TRUE(all[0].scene.actors.empty());
  EXPECT_DOUBLE_EQ(all[0].scene.grip, 0.4);
}

TEST(Suppositions, NamesStayUniqueAndAFullSceneTakesNobody) {
  Scene scene = road(CueKind::bus_at_stop, 20.0, -3.0);
  intent::Beliefs beliefs;
  for (std::size_t k = 0; k + 1 < world::max_actors; ++k) {
    world::Actor other = test::car(1, {500.0 + 10.0 * static_cast<double>(k), 0.0});
    other.kind = ActorKind::pedestrian;
    other.id = static_cast<std::uint8_t>(255 - k);
    scene.actors.push_back(other);
    beliefs.push_back({});
  }
  const Suppositions all = suppositions(scene, beliefs, law());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].scene.actors.size(), world::max_actors);
  EXPECT_FALSE(world::broken_rule(all[0].scene));
  EXPECT_TRUE(suppositions(all[0].scene, all[0].beliefs, law()).empty());
  EXPECT_THROW((void)suppositions(scene, {}, law()), ContractViolation);
}

}  // namespace
}  // namespace saca::preview::supposed_test
