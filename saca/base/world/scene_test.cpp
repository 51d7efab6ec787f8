#include "saca/base/world/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

#include "tests/support/scenes.h"

namespace saca::world::scene_test {
namespace {

Scene good_scene() {
  Scene scene = test::ego_at(0.0);
  scene.actors.push_back(test::car(1, {}));
  scene.actors.push_back(test::car(2, {}));
  return scene;
}

TEST(Scene, CrossesBetweenPlanesByteByByte) {
  EXPECT_TRUE(std::is_trivially_copyable_v<Scene>);
}

TEST(Scene, AGoodSceneBreaksNoRule) {
  EXPECT_EQ(broken_rule(good_scene()), std::nullopt);
}

TEST(Scene, EachRuleIsChecked) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(Scene&)>> breaks{
      [](Scene& s) { s.time = nan; },
      [](Scene& s) { s.time = 1.7e9; },  // since 1970
      [](Scene& s) { s.ego.v_B.x = nan; },
      [](Scene& s) { s.ego.X_WB.yaw = std::numeric_limits<double>::infinity(); },
      [](Scene& s) { s.ego_footprint.width = 0.0; },
      [](Scene& s) { s.ego_mass = -1.0; },
      [](Scene& s) { s.road.lane_width = nan; },
      [](Scene& s) { s.road.lane_width = 2e3; },
      [](Scene& s) { s.road.X_WL.p.x = 2e7; },
      [](Scene& s) { s.road.X_WL.yaw = nan; },
      [](Scene& s) { s.road.X_WL.yaw = -1e300; },
      [](Scene& s) { s.ego.X_WB.yaw = 1e300; },
      [](Scene& s) { s.actors[1].X_WA.yaw = 2e4; },
      [](Scene& s) { s.road.curvature = -1.1; },
      [](Scene& s) { s.road.left_edge = -1.0; },
      [](Scene& s) { s.road.right_edge = 1.0; },
      [](Scene& s) { s.road.right_edge = -2e7; },
      [](Scene& s) { s.grip = 0.0; },
      [](Scene& s) { s.grip = nan; },
      [](Scene& s) { s.grip_sd = 2e7; },
      [](Scene& s) { s.actors[1].v_W.y = nan; },
      [](Scene& s) { s.actors[1].mass = 0.0; },
      [](Scene& s) { s.actors[1].existence = 1.1; },
      [](Scene& s) { s.actors[1].position_sd = nan; },
      [](Scene& s) { s.actors[1].age = 2e7; },
      [](Scene& s) { s.actors[1].v_W.x = 1e308; },
      [](Scene& s) { s.ego.yaw_rate = 1e6; },
      [](Scene& s) { s.actors[1].id = 1; },
      [](Scene& s) { s.actors[1].shared = {.steering = 2.0}; },
      [](Scene& s) { s.actors[1].shared = {.brake = 1.1}; },
      [](Scene& s) { s.actors[1].shared = {.throttle = -0.1}; },
      [](Scene& s) {
        s.actors[1].footprint = {Shape::segment, 9.0, 0.0};
      },  // a car
      [](Scene& s) {
        s.actors[1].kind = ActorKind::obstacle;
        s.actors[1].footprint = {Shape::segment, 9.0, 0.5};
      },
      [](Scene& s) {
        s.ego_footprint = {Shape::segment, 4.7, 0.0};
      },
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    Scene scene = good_scene();
    breaks[i](scene);
    EXPECT_NE(broken_rule(scene), std::nullopt) << "rule " << i;
  }
}

TEST(Scene, AWallIsAnObstacleWithoutWidth) {
  Scene scene = good_scene();
  scene.actors[1].kind = ActorKind::obstacle;
  scene.actors[1].footprint = {Shape::segment, 9.0, 0.0};
  EXPECT_EQ(broken_rule(scene), std::nullopt);
}

TEST(Scene, NamesGoThereAndBack) {
  EXPECT_EQ(actor_kind_from(name(ActorKind::truck)), ActorKind::truck);
  EXPECT_EQ(actor_kind_from("tank"), std::nullopt);
  EXPECT_EQ(actor_name(test::car(3, {})), "car3");
}

}  // namespace
}  // namespace saca::world::scene_test
