#include "saca/thinking/rollout/story.h"

#include <gtest/gtest.h>

#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::rollout::story_test {
namespace {

const collision::HarmModel& harm() {
  static const collision::HarmModel shipped = shipped_harm();
  return shipped;
}

std::vector<const collision::Mover*> each_of(const std::vector<collision::Mover>& movers) {
  std::vector<const collision::Mover*> all;
  for (const collision::Mover& mover : movers) {
    all.push_back(&mover);
  }
  return all;
}

/// At 10 m/s towards a car at rest, 20 m to go; a second one stands far beyond.
Encounter two_ahead() {
  Encounter encounter;
  encounter.motion = steady_ego({}, {10.0, 0.0}, 0.0, 4.0);
  encounter.add_car({{20.0 + test::ego_body.length, 0.0}, 0.0}, {});
  encounter.add_car({{90.0, 0.0}, 0.0}, {});
  return encounter;
}

// 20 m at 10 m/s.
TEST(Story, TellsFirstWhoIsMetFirst) {
  const Encounter encounter = two_ahead();
  forecast::PreparedMotion motion(encounter.motion, encounter.scene);
  const auto movers = forecast::movers_of(encounter.scene, encounter.tracks);
  Story story(motion, harm(), 0.9);
  story.expect(each_of(movers));
  const auto event = story.next();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->actor, 0U);
  EXPECT_NEAR(event->time, 2.0, 1e-4);
  EXPECT_FALSE(event->presses_on);
  EXPECT_FALSE(story.struck()[0]);
  EXPECT_TRUE(story.happen(*event));
  EXPECT_TRUE(story.struck()[0]);
  EXPECT_FALSE(story.struck()[1]);
}

// Up to the impact the ego moves as it was meant to, and then slides; with velocities or without.
TEST(Story, TheWayOfTheEgoIsThatOfItsMotion) {
  const Encounter encounter = two_ahead();
  forecast::PreparedMotion motion(encounter.motion, encounter.scene);
  const auto movers = forecast::movers_of(encounter.scene, encounter.tracks);
  Story story(motion, harm(), 0.9, only_contacts);
  story.expect(each_of(movers));
  EXPECT_EQ(end_time(story.ego_track()), end_time(encounter.motion.track));
  while (const auto event = story.next()) {
    story.happen(*event);
    const manoeuvre::EgoMotion ego = story.ego();
    const world::Track& track = story.ego_track();
    ASSERT_EQ(track.X_WA.size(), ego.track.X_WA.size());
    for (std::size_t k = 0; k < track.X_WA.size(); ++k) {
      EXPECT_EQ(track.X_WA[k].p.x, ego.track.X_WA[k].p.x);
    }
  }
  EXPECT_NEAR(pose_at(story.ego_track(), 1.9).p.x, 19.0, 1e-9);
  EXPECT_LT(story.ego_track().X_WA.back().p.x, 35.0);  // half the speed is left, and brakes
  EXPECT_GT(story.others()[0].X_WA.back().p.x, encounter.tracks[0].X_WA.back().p.x);
}

TEST(Story, RefusesOthersThatAreNotThere) {
  const Encounter encounter = two_ahead();
  forecast::PreparedMotion motion(encounter.motion, encounter.scene);
  Story story(motion, harm(), 0.9);
  EXPECT_THROW(story.expect({}), ContractViolation);
}

}  // namespace
}  // namespace saca::rollout::story_test
