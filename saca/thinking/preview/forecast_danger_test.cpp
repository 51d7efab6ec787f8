#include "saca/thinking/preview/forecast_danger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "saca/base/core/contract.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/forecast_for_test.h"
#include "saca/thinking/preview/preview.h"
#include "tests/support/scenes.h"

namespace saca::preview::forecast_danger_test {
namespace {

using manoeuvre::PolicyId;
using world::Actor;
using world::Scene;

const manoeuvre::Car& ego_car() {
  return atlas::small_atlas_car();
}

/// A wide road, so that no edge matters.
Scene road(double speed) {
  Scene scene = test::ego_at(speed, manoeuvre::footprint(ego_car()));
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -8.75;
  return scene;
}

PolicyDangers dangers(const Scene& scene) {
  static const danger::DangerModel model(danger::avoidance_of(ego_car(), 0.9),
                                         manoeuvre::footprint(ego_car()), {});
  ForecastTools tools = rolling();
  tools.danger = &model;
  const auto tracks = all_going_on(scene).tracks;
  return policy_dangers(scene, tracks, obstacle_risks(scene, tools),
                        policy_facts(scene, tracks, tools), tools);
}

double danger(const PolicyDangers& all, PolicyId policy) {
  return all[manoeuvre::index(policy)].value();
}

/// Too wide to be passed: only braking helps.
Actor wall(double face) {
  Actor actor = test::car(1, {face + 2.0, 0.0});
  actor.kind = world::ActorKind::obstacle;
  actor.footprint = {.length = 4.0, .width = 400.0};
  return actor;
}

// A stop from v needs v^2 / (2 mu g): whoever goes on for half a second has 0.5 v less for it.
TEST(PolicyDangers, BeforeAWallTheyAreWhatAStopOverruns) {
  constexpr double v = 15.0;
  Scene scene = road(v);
  const double front = 0.5 * scene.ego_footprint.length + scene.ego_footprint.centre_x;
  const double stop = v * v / (2.0 * scene.grip * vehicle::gravity);
  for (const double spare : {6.0, 20.0}) {  // [m] after a stop begun now
    scene.actors.clear();
    scene.actors.push_back(wall(front + stop + spare));
    const PolicyDangers all = dangers(scene);
    EXPECT_NEAR(danger(all, PolicyId::no_intervention), committed * v - spare, 0.4);
    // Brakes build up within 0.15 s or so: some 2 m are lost, not the 7.5 m of whoever goes on.
    EXPECT_GT(danger(all, PolicyId::aeb), -spare - 0.1);
    EXPECT_LT(danger(all, PolicyId::aeb), -spare + 0.2 * v);
  }
}

TEST(PolicyDangers, InAMirrorLeftAndRightChangePlaces) {
  Scene scene = road(18.0);
  scene.actors.push_back(test::car(1, {22.0, 0.7}));
  Scene mirrored = scene;
  mirrored.actors[0].X_WA.p.y = -0.7;
  const PolicyDangers one = dangers(scene);
  const PolicyDangers other = dangers(mirrored);
  using enum PolicyId;
  constexpr double step = 0.05;  // [m]: an evasion goes straight on from the first step of which it
                                 // may, and rounding decides which that is
  for (const auto& [left, right] :
       {std::pair{aes_left, aes_right}, std::pair{es_b_left, es_b_right}}) {
    EXPECT_NEAR(danger(one, left), danger(other, right), step);
    EXPECT_LT(danger(one, right), danger(one, left));  // it stands to the left
  }
}

// Within half a second the ego runs through somebody and out again: that counts, though from there
// on nothing is in the way.
TEST(PolicyDangers, WhoIsRunThroughOnTheWayCounts) {
  Scene scene = road(20.0);
  Actor person = test::car(1, {4.0, 0.0});
  person.kind = world::ActorKind::pedestrian;
  person.footprint = {.shape = world::Shape::ellipse, .length = 0.5, .width = 0.5};
  scene.actors.push_back(person);
  EXPECT_GT(danger(dangers(scene), PolicyId::no_intervention), 0.5);
}

TEST(PolicyDangers, TheMostDangerousOfSeveralCounts) {
  Scene scene = road(15.0);
  scene.actors.push_back(test::car(1, {25.0, 0.0}));
  const PolicyDangers alone = dangers(scene);
  scene.actors.push_back(test::car(2, {60.0, -3.5}));
  const PolicyDangers beside = dangers(scene);
  EXPECT_EQ(danger(alone, PolicyId::aeb), danger(beside, PolicyId::aeb));
}

// Four who stand far apart: whoever is fourth is looked at on the way only.
TEST(PolicyDangers, AreOfTheThreeMostDangerous) {
  Scene scene = road(15.0);
  for (const double x : {20.0, 40.0, 60.0}) {
    scene.actors.push_back(test::car(static_cast<std::uint8_t>(scene.actors.size() + 1), {x, 0.0}));
  }
  const PolicyDangers three = dangers(scene);
  scene.actors.push_back(test::car(4, {90.0, 0.0}));
  const PolicyDangers four = dangers(scene);
  for (std::size_t i = 0; i < three.size(); ++i) {
    EXPECT_EQ(three[i], four[i]) << i;
  }
}

TEST(PolicyDangers, NobodyAheadOrNoWayToDriveHasNone) {
  Scene scene = road(15.0);
  for (const auto& one : dangers(scene)) {
    EXPECT_FALSE(one.has_value());
  }
  scene.actors.push_back(test::car(1, {-20.0, 0.0}, {15.0, 0.0}));
  for (const auto& one : dangers(scene)) {
    EXPECT_FALSE(one.has_value());
  }
  Scene crawling = road(1.0);  // too slow for a lane change
  crawling.actors.push_back(test::car(1, {5.0, 0.0}));
  const PolicyDangers all = dangers(crawling);
  EXPECT_TRUE(all[manoeuvre::index(PolicyId::aeb)].has_value());
  EXPECT_FALSE(all[manoeuvre::index(PolicyId::aes_left)].has_value());
}

TEST(PolicyDangers, AnotherNumberOfTracksIsRefused) {
  const Scene scene = road(15.0);
  const danger::DangerModel model(danger::avoidance_of(ego_car(), 0.9), scene.ego_footprint, {});
  ForecastTools tools = rolling();
  tools.danger = &model;
  const AllFacts facts = policy_facts(scene, {}, tools);
  EXPECT_THROW((void)policy_dangers(scene, {world::Track{}}, {}, facts, tools), ContractViolation);
  EXPECT_THROW((void)policy_dangers(scene, {}, {{}}, facts, tools), ContractViolation);
  tools.danger = nullptr;
  EXPECT_THROW((void)policy_dangers(scene, {}, {}, facts, tools), ContractViolation);
}

}  // namespace
}  // namespace saca::preview::forecast_danger_test
