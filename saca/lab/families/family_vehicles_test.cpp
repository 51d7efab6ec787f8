#include "saca/lab/families/family_vehicles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "saca/lab/scenario/motion.h"

namespace saca::families::family_vehicles_test {
namespace {

class Conflict : public testing::Test {
 protected:
  void begin(FamilyKind kind) {
    family_ = load_family("scenarios/families", name(kind)).value();
    for (const char* key : {"van_share", "truck_share"}) {
      always(key, 0.0);
    }
    always("lane_width_m", 3.5);
  }
  void always(const std::string& key, double value) { family_.ranges[key] = {value, value, "t"}; }
  scenario::Scenario played(Harmless (*kind)(Stage&)) {
    Dice dice(family_, rng_);
    Stage stage(dice, scenario::standard_ego, false);
    (void)kind(stage);
    return stage.scenario;
  }
  /// Of the first actor at a time, against the ego's front.
  static Vec2 from_front(const scenario::Scenario& scenario, double time) {
    const Pose ego = scenario::ego_at(scenario, time).X_WB;
    const Pose other = scenario::actor_pose(scenario, 0, time, {});
    return {other.p.x - ego.p.x - 2.25, other.p.y};
  }

  Family family_;
  std::mt19937_64 rng_{5};
};

TEST_F(Conflict, TheSlowerOnesRearIsMetWhenTheApproachIsOver) {
  begin(FamilyKind::slower_lead);
  always("ego_speed_mps", 15.0);
  always("lead_mps", 5.0);
  const scenario::Scenario scenario = played(slower_lead);
  EXPECT_NEAR(from_front(scenario, Stage::approach).x, 0.5 * 4.02, 1e-9);
  EXPECT_NEAR(from_front(scenario, Stage::approach - 1.0).x, 0.5 * 4.02 + 10.0, 1e-9);
}

TEST_F(Conflict, WhoShouldBeSlowerIsSlower) {
  begin(FamilyKind::slower_lead);
  always("ego_speed_mps", 10.0);
  always("lead_mps", 30.0);
  EXPECT_NEAR(std::get<scenario::Script>(played(slower_lead).actors[0].motion).speed, 6.0, 1e-12);
}

// Bodies of 1.9 and 1.71 m touch where their centres are 1.805 m apart.
TEST_F(Conflict, TheOneBesideTouchesOurSideWhenTheApproachIsOver) {
  begin(FamilyKind::sideswipe);
  always("ego_speed_mps", 20.0);
  always("other_speed_mps", 18.0);
  always("beside_ahead_m", 1.0);
  for (const double from_left : {0.0, 1.0}) {
    always("from_left_share", from_left);
    const scenario::Scenario scenario = played(sideswipe);
    const Vec2 there = from_front(scenario, Stage::approach);
    EXPECT_NEAR(there.y, from_left > 0.0 ? 1.805 : -1.805, 0.02);
    EXPECT_NEAR(there.x, 1.0 - 2.35, 0.02);
  }
}

TEST_F(Conflict, TheOneBesideIsBesideUs) {
  begin(FamilyKind::sideswipe);
  always("beside_ahead_m", 50.0);
  const Vec2 there = from_front(played(sideswipe), Stage::approach);
  // Centres at most half of both lengths apart but for a tenth of the shorter body, 4.02 m.
  EXPECT_NEAR(there.x, 0.5 * (4.7 + 4.02) - 0.402 - 2.35, 0.05);
}

// The body's extent along our lane then: between width and length of a car.
TEST_F(Conflict, WhoTurnsIsInTheMiddleOfOurLaneWhenHeIsLate) {
  begin(FamilyKind::turning);
  always("late_s", 0.4);
  for (const auto& [from, turn] :
       {std::pair{180.0, 90.0}, {90.0, 90.0}, {-90.0, 90.0}, {90.0, -90.0}}) {
    always("from_deg", from);
    always("turn_deg", turn);
    const scenario::Scenario scenario = played(turning);
    const double time = Stage::approach + 0.4;
    const Vec2 there = from_front(scenario, time);
    EXPECT_NEAR(there.y, 0.0, 0.15) << from << " " << turn;
    const double head = there.x + 0.4 * std::get<scenario::EgoStart>(scenario.ego).speed;
    EXPECT_GE(head, 0.5 * 1.71 - 0.1) << from << " " << turn;
    EXPECT_LE(head, 0.5 * (1.71 + 4.02)) << from << " " << turn;
  }
}

TEST_F(Conflict, WhoTurnsIntoALaneEndsInIt) {
  begin(FamilyKind::turning);
  for (const auto& [from, turn, d, heading] : {std::tuple{90.0, 90.0, 3.5, std::numbers::pi},
                                               {90.0, -90.0, 0.0, 0.0},
                                               {-90.0, 90.0, 0.0, 0.0}}) {
    always("from_deg", from);
    always("turn_deg", turn);
    const scenario::Scenario scenario = played(turning);
    const Pose end = scenario::actor_pose(scenario, 0, scenario.duration, {});
    EXPECT_NEAR(end.p.y, d, 1e-6) << from << " " << turn;
    EXPECT_NEAR(std::abs(end.yaw), heading, 1e-6) << from << " " << turn;
  }
}

TEST_F(Conflict, WhoComesTowardsUsBeginsBesideUsAndLeavesOurLaneBehind) {
  begin(FamilyKind::turning);
  const scenario::Scenario scenario = played(turning);
  EXPECT_NEAR(scenario::actor_pose(scenario, 0, 0.0, {}).p.y, 3.5, 1e-9);
  EXPECT_LT(scenario::actor_pose(scenario, 0, scenario.duration, {}).p.y, -3.5);
}

TEST_F(Conflict, AMotorcycleIsThereOnlyWhereTheFamilyHasAShareOfThem) {
  begin(FamilyKind::slower_lead);
  EXPECT_EQ(played(slower_lead).actors[0].kind, world::ActorKind::car);
  always("motorcycle_share", 1.0);
  EXPECT_EQ(played(slower_lead).actors[0].kind, world::ActorKind::motorcycle);
}

}  // namespace
}  // namespace saca::families::family_vehicles_test
