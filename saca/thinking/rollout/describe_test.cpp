#include "saca/thinking/rollout/describe.h"

#include <gtest/gtest.h>

namespace saca::rollout::describe_test {
namespace {

world::Scene scene_with_a_truck() {
  world::Scene scene;
  scene.actors.push_back({.id = 2, .kind = world::ActorKind::truck});
  return scene;
}

TEST(Describe, SaysHowFarItStayedClearOfWhomAndWhen) {
  const world::Scene scene = scene_with_a_truck();
  EXPECT_EQ(describe(collision::Outcome{}, scene), "clear: nobody within 100 m");
  collision::Outcome outcome{.clearance = 1.24,
                             .nearest = collision::Nearest{.actor = 0, .time = 5.36}};
  EXPECT_EQ(describe(outcome, scene), "clear by 1.2 m (nearest: truck2 at 5.4 s)");
  outcome.nearest = collision::Nearest{.edge = collision::Side::right, .time = 2.0};
  EXPECT_EQ(describe(outcome, scene), "clear by 1.2 m (nearest: the road's right edge at 2.0 s)");
}

TEST(Describe, NamesWhoIsHitWhereAndHowFast) {
  collision::Contact contact{.actor = 0, .ego_face = collision::Face::rear, .relative_speed = 4.21};
  EXPECT_EQ(describe(collision::Outcome{.contact = contact}, scene_with_a_truck()),
            "hits truck2 with its rear at 4.2 m/s");
  contact.actor.reset();
  EXPECT_EQ(describe(collision::Outcome{.contact = contact}, scene_with_a_truck()),
            "leaves the road with its rear at 4.2 m/s");
}

TEST(Describe, GoesOnToWhatFollows) {
  collision::Outcome outcome{.contact = collision::Contact{.actor = 0, .relative_speed = 9.0}};
  outcome.later.push_back(
      {.edge = collision::Side::left, .ego_face = collision::Face::left, .relative_speed = 3.04});
  outcome.later.push_back({.actor = 0, .ego_face = collision::Face::rear, .relative_speed = 1.0});
  EXPECT_EQ(describe(outcome, scene_with_a_truck()),
            "hits truck2 with its front at 9.0 m/s, then the road's edge with its left at 3.0 m/s, "
            "then truck2 with its rear at 1.0 m/s");
}

}  // namespace
}  // namespace saca::rollout::describe_test
