#include "saca/lab/families/family_stage.h"

#include <gmock/gmock.h>

#include <numbers>

namespace saca::families::family_stage_test {
namespace {

using world::ActorKind;

class Staging : public testing::Test {
 protected:
  Family family_ = load_family("scenarios/families", "crossing").value();
  std::mt19937_64 rng_{5};
  Dice dice_{family_, rng_};

  void always(const std::string& key, double value) { family_.ranges[key] = {value, value, "t"}; }
};

TEST_F(Staging, DiceFallWithinTheirRanges) {
  family_.ranges["late_s"] = {-0.5, 0.25, "test"};
  for (int i = 0; i < 1000; ++i) {
    const double late = dice_.in("late_s");
    EXPECT_TRUE(late >= -0.5 && late < 0.25) << late;
  }
  EXPECT_THROW((void)dice_.in("no_such_key"), ContractViolation);
}

// 2000 throws: four standard errors are 4 sqrt(0.3 * 0.7 / 2000) = 0.041.
TEST_F(Staging, SharesAreProbabilities) {
  always("truck_share", 0.3);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    hits += dice_.happens("truck_share") ? 1 : 0;
  }
  EXPECT_NEAR(hits / 2000.0, 0.3, 0.041);
}

TEST_F(Staging, TheEgosFrontIsAtTheHeadWhenTheApproachIsOver) {
  const Stage stage(dice_, scenario::standard_ego, true);
  EXPECT_DOUBLE_EQ(stage.front, 2.25);
  EXPECT_DOUBLE_EQ(stage.rear, 2.45);
  EXPECT_DOUBLE_EQ(stage.head(), stage.front + Stage::approach * stage.speed);
}

TEST_F(Staging, TheRoadHasRoomForTheLanesThatWereDrawn) {
  always("left_lane_share", 1.0);
  always("right_lane_share", 0.0);
  always("shoulder_m", 0.5);
  const Stage stage(dice_, scenario::standard_ego, false);
  EXPECT_NEAR(stage.scenario.road.left_edge, 1.5 * stage.lane() + 0.5, 0.02);
  EXPECT_NEAR(stage.scenario.road.right_edge, -0.5 * stage.lane() - 0.5, 0.02);
}

TEST_F(Staging, SurroundingsStandWhereTheEgoMeetsThem) {
  always("left_lane_share", 1.0);
  always("oncoming_share", 1.0);
  always("left_busy_share", 1.0);
  always("oncoming_ahead_m", 30.0);
  always("neighbour_speed_share", 0.5);
  always("follower_share", 1.0);
  always("follower_gap_s", 1.0);
  Stage stage(dice_, scenario::standard_ego, false);
  stage.decision = 4.0;
  stage.add_surroundings();
  ASSERT_EQ(stage.scenario.actors.size(), 2U);
  const auto& follower = std::get<scenario::Script>(stage.scenario.actors[0].motion);
  const double length = Stage::length_of(ActorKind::car);
  EXPECT_NEAR(-stage.rear - (follower.start.s + 0.5 * length), stage.speed, 1e-9);  // 1 s behind
  EXPECT_EQ(follower.behaviour, scenario::Behaviour::follow);
  const auto& oncoming = std::get<scenario::Script>(stage.scenario.actors[1].motion);
  EXPECT_EQ(oncoming.start.heading, std::numbers::pi);
  const double nose = oncoming.start.s - 4.0 * oncoming.speed - 0.5 * length;
  EXPECT_NEAR(nose - (4.0 * stage.speed + stage.front), 30.0, 1e-9);
  EXPECT_DOUBLE_EQ(oncoming.speed, 0.5 * stage.speed);
}

TEST_F(Staging, BodiesOfOneKindAreNumbered) {
  Stage stage(dice_, scenario::standard_ego, false);
  stage.add(ActorKind::car, {});
  stage.add(ActorKind::truck, {});
  stage.add(ActorKind::car, {});
  EXPECT_EQ(stage.scenario.actors[0].id, 1);
  EXPECT_EQ(stage.scenario.actors[1].id, 1);
  EXPECT_EQ(stage.scenario.actors[2].id, 2);
}

}  // namespace
}  // namespace saca::families::family_stage_test
