#include "saca/lab/benchmarks/crowd.h"

#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::benchmarks::crowd_test {
namespace {

TEST(Crowd, IsTheSameInEveryCallAndOtherwiseInEveryScene) {
  const auto scenes = crowds(prepare::default_car(), 8);
  ASSERT_EQ(scenes.size(), 64U);
  EXPECT_EQ(crowds(prepare::default_car(), 8)[63].actors[7].X_WA.p, scenes[63].actors[7].X_WA.p);
  EXPECT_NE(scenes[0].ego.v_B.x, scenes[1].ego.v_B.x);
  for (const world::Scene& scene : scenes) {
    EXPECT_NEAR(scene.ego.v_B.x, 20.0, 1.0);
    ASSERT_EQ(scene.actors.size(), 8U);
    EXPECT_NEAR(scene.actors[0].X_WA.p.y, 0.0, 0.5) << "the first is in the ego's own lane";
    for (const world::Actor& actor : scene.actors) {
      EXPECT_FALSE(broken_rule(actor).has_value());
      EXPECT_GT(actor.X_WA.p.x, 10.0);
    }
  }
}

TEST(Crowd, WhoFollowsIsAsFastAsTheEgo) {
  auto scenes = crowds(prepare::default_car(), 2);
  follow_ego(scenes);
  for (const world::Scene& scene : scenes) {
    EXPECT_EQ(scene.actors[1].X_WA.p.x, -20.0);
    EXPECT_EQ(scene.actors[1].v_W.x, scene.ego.v_B.x);
    EXPECT_GT(scene.actors[0].X_WA.p.x, 0.0);
  }
}

}  // namespace
}  // namespace saca::benchmarks::crowd_test
