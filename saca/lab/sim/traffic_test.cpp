#include "saca/lab/sim/traffic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"

namespace saca::sim::traffic_test {
namespace {

constexpr world::Footprint car{.length = 4.0, .width = 1.8};
constexpr world::Footprint ego{.length = 4.7, .width = 1.9, .centre_x = -0.1};

scenario::ScenarioActor actor(std::uint8_t id,
                              const std::variant<scenario::Script, scenario::Recording>& motion) {
  return {.id = id, .footprint = car, .mass = 1'500.0, .motion = motion};
}

/// Behind the ego, content with its gap.
scenario::Script follower(double s, double speed, double gap) {
  scenario::Script script{
      .start = {.s = s}, .speed = speed, .behaviour = scenario::Behaviour::follow};
  script.law = content_with(drivers::usual_driver(speed), speed, gap);
  return script;
}

scenario::Scenario with(std::vector<scenario::ScenarioActor> actors) {
  scenario::Scenario scenario;
  scenario.actors = std::move(actors);
  return scenario;
}

/// The ego from the origin at a speed, braking from `from` on.
world::Track ego_track(double speed, double from, double deceleration, double seconds = 10.0) {
  world::Track track{.start = 0.0, .step = Traffic::step, .X_WA = {}};
  for (int k = 0; k <= static_cast<int>(seconds / Traffic::step); ++k) {
    const double time = k * Traffic::step;
    const double t = std::clamp(time - from, 0.0, speed / deceleration);
    const double coasting = std::min(time, from);
    track.X_WA.push_back({{speed * (coasting + t) - 0.5 * deceleration * t * t, 0.0}, 0.0});
  }
  return track;
}

manoeuvre::EgoMotion motion_of(const world::Track& X_WB) {
  manoeuvre::EgoMotion motion{.track = X_WB, .v_B = {}, .yaw_rate = {}};
  for (std::size_t k = 0; k < X_WB.X_WA.size(); ++k) {
    const double time = X_WB.start + X_WB.step * static_cast<double>(k);
    motion.v_B.push_back(rotated(world::velocity_at(X_WB, time), -X_WB.X_WA[k].yaw));
    motion.yaw_rate.push_back(0.0);
  }
  return motion;
}

void drive(Traffic& traffic, const world::Track& X_WB, double until) {
  while (traffic.time() < until - 1e-9) {
    traffic.advance(world::pose_at(X_WB, traffic.time()), world::velocity_at(X_WB, traffic.time()),
                    ego);
  }
}

TEST(Traffic, PlaysScriptsAsWritten) {
  scenario::Script crossing{.start = {30.0, 20.0, -std::numbers::pi / 2.0}, .speed = 7.0};
  const scenario::Scenario scenario = with({actor(1, crossing)});
  Traffic traffic(scenario);
  drive(traffic, ego_track(10.0, 99.0, 1.0), 2.0);
  const world::Actor now = traffic.actors()[0];
  EXPECT_NEAR(now.X_WA.p.y, 20.0 - 14.0, 1e-9);
  EXPECT_NEAR(now.v_W.y, -7.0, 1e-9);
  EXPECT_NEAR(norm(now.a_W), 0.0, 1e-9);
  EXPECT_EQ(now.existence, 1.0);
}

TEST(Traffic, KnowsAccelerationsAsATrackerWould) {
  scenario::Script braking{.start = {.s = 60.0},
                           .speed = 15.0,
                           .behaviour = scenario::Behaviour::brake,
                           .acceleration = 5.0,
                           .from = 1.0};
  const scenario::Scenario scenario = with({actor(1, braking)});
  Traffic traffic(scenario);
  drive(traffic, ego_track(10.0, 99.0, 1.0), 1.25);
  EXPECT_NEAR(traffic.actors()[0].a_W.x, -5.0 * 0.5, 0.06);  // half of 0.5 s it has braked
  drive(traffic, ego_track(10.0, 99.0, 1.0), 1.6);
  EXPECT_NEAR(traffic.actors()[0].a_W.x, -5.0, 1e-6);
}

// The same, computed by reacting_track against the ego alone.
TEST(Traffic, AFollowerDrivesAsItsLawSays) {
  const scenario::Script script = follower(-20.0, 15.0, 15.55);
  const scenario::Scenario scenario = with({actor(1, script)});
  const world::Track X_WB = ego_track(15.0, 1.0, 5.0);
  const world::Track track = Traffic(scenario).against(motion_of(X_WB), ego, 8.0).at(0);
  world::Actor driver{.footprint = car, .X_WA = {{-20.0, 0.0}, 0.0}, .v_W = {15.0, 0.0}};
  const drivers::Body body{&ego, &X_WB};
  const world::Track expected =
      reacting_track(scenario.road, driver, script.law, {&body, 1},
                     {.start = 0.0, .duration = 8.0, .step = Traffic::step, .grip = scenario.grip});
  ASSERT_EQ(track.X_WA.size(), expected.X_WA.size());
  for (std::size_t k = 0; k < track.X_WA.size(); ++k) {
    EXPECT_NEAR(track.X_WA[k].p.x, expected.X_WA[k].p.x, 1e-9) << k;
  }
  EXPECT_LT(track.X_WA.back().p.x, 0.9 * 15.0 * 8.0 - 20.0);
}

// One behind the other: the second reacts to the first, not through it to the ego.
TEST(Traffic, FollowersReactToOneAnother) {
  const scenario::Scenario scenario =
      with({actor(1, follower(-40.0, 15.0, 16.0)), actor(2, follower(-20.0, 15.0, 15.55))});
  const auto tracks = Traffic(scenario).against(motion_of(ego_track(15.0, 1.0, 4.0)), ego, 10.0);
  for (std::size_t k = 0; k < tracks[0].X_WA.size(); ++k) {
    EXPECT_LT(tracks[0].X_WA[k].p.x + 4.0, tracks[1].X_WA[k].p.x) << k;
  }
  EXPECT_LT(world::velocity_at(tracks[0], 9.9).x, 2.0);
}

TEST(Traffic, AgainstIsCausalAndLeavesTheTrafficAlone) {
  const scenario::Scenario scenario = with({actor(1, follower(-20.0, 15.0, 15.55))});
  Traffic traffic(scenario);
  drive(traffic, ego_track(15.0, 3.0, 6.0), 2.0);
  const auto later = traffic.against(motion_of(ego_track(15.0, 3.0, 6.0)), ego, 8.0);
  const auto never = traffic.against(motion_of(ego_track(15.0, 99.0, 6.0)), ego, 8.0);
  EXPECT_EQ(later[0].start, 2.0);
  for (std::size_t k = 0; k <= 100; ++k) {
    EXPECT_EQ(later[0].X_WA[k].p.x, never[0].X_WA[k].p.x);
  }
  EXPECT_LT(later[0].X_WA.back().p.x, never[0].X_WA.back().p.x - 10.0);
  drive(traffic, ego_track(15.0, 3.0, 6.0), 5.0);
  EXPECT_EQ(traffic.actors()[0].X_WA.p.x, later[0].X_WA[300].p.x);
}

TEST(Traffic, TheSameTwiceBitByBit) {
  const scenario::Scenario scenario =
      with({actor(1, follower(-20.0, 15.0, 15.55)),
            actor(2, scenario::Script{.start = {.s = 50.0, .d = 1.0}, .speed = 9.0})});
  const scenario::Chance chance = scenario::draw_chance(3, 7, 1.0);
  const auto a = Traffic(scenario, chance).against(motion_of(ego_track(15.0, 1.0, 6.0)), ego, 6.0);
  const auto b = Traffic(scenario, chance).against(motion_of(ego_track(15.0, 1.0, 6.0)), ego, 6.0);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < a[i].X_WA.size(); ++k) {
      EXPECT_EQ(std::memcmp(&a[i].X_WA[k], &b[i].X_WA[k], sizeof(Pose)), 0);
    }
  }
}

TEST(Traffic, GhostsAreSeenByNobodyWhoDrives) {
  scenario::ScenarioActor ghost =
      actor(2, scenario::Script{.start = {.s = 30.0}, .behaviour = scenario::Behaviour::hold});
  ghost.ghost = true;
  ghost.existence = 0.4;
  // The ego is beside: it sees the road ahead free but for the ghost.
  const scenario::Scenario scenario = with({actor(1, follower(-20.0, 15.0, 100.0)), ghost});
  const world::Track aside{.X_WA = {{{0.0, 20.0}, 0.0}}};
  const Traffic traffic(scenario);
  EXPECT_GT(traffic.against(motion_of(aside), ego, 6.0).at(0).X_WA.back().p.x, 60.0);
  ASSERT_EQ(traffic.actors().size(), 1U);
  ASSERT_EQ(traffic.ghosts().size(), 1U);
  EXPECT_EQ(traffic.ghosts()[0].existence, 0.4);
}

TEST(Traffic, ChanceMakesADriverSlowerToReactAndFaster) {
  const scenario::Scenario scenario = with({actor(1, follower(-20.0, 15.0, 15.55))});
  const auto x_end = [&](const scenario::ActorChance& drawn, double from) {
    scenario::Chance chance;
    chance.from = from;
    chance.actors[0] = drawn;
    return Traffic(scenario, chance).against(motion_of(ego_track(15.0, 1.0, 6.0)), ego, 3.0).at(0);
  };
  const world::Track usual = x_end({}, 0.0);
  // It acts on what happens at 1 s at 1 + 1.25 s, or 2 s.
  const world::Track late = x_end({.reaction = 1.6}, 0.0);
  EXPECT_NEAR(world::velocity_at(usual, 2.2).x, 15.0, 0.02);
  EXPECT_LT(world::velocity_at(usual, 2.6).x, 14.5);
  EXPECT_NEAR(world::velocity_at(late, 2.9).x, 15.0, 0.02);
  const world::Track moved = x_end({.ahead = 0.3, .aside = -0.1}, 0.0);
  EXPECT_NEAR(moved.X_WA[0].p.x, usual.X_WA[0].p.x + 0.3, 1e-12);
  EXPECT_NEAR(moved.X_WA[0].p.y, -0.1, 1e-12);
  const world::Track fast = x_end({.speed = 1.1}, 0.5);
  EXPECT_NEAR(world::velocity_at(fast, 0.455).x, 15.0, 1e-6);
  EXPECT_NEAR(world::velocity_at(fast, 0.515).x, 16.5, 0.02);
}

TEST(Traffic, RecordedFollowersReactOnceTheyAreLetGo) {
  const scenario::Recording behind{{.time = 0.0, .X_WA = {{-20.0, 0.0}, 0.0}, .speed = 15.0},
                                   {.time = 9.0, .X_WA = {{115.0, 0.0}, 0.0}, .speed = 15.0}};
  const scenario::Recording beside{{.time = 0.0, .X_WA = {{-20.0, 3.5}, 0.0}, .speed = 15.0},
                                   {.time = 9.0, .X_WA = {{115.0, 3.5}, 0.0}, .speed = 15.0}};
  const scenario::Scenario scenario = with({actor(1, behind), actor(2, beside)});
  Traffic traffic(scenario);
  const world::Track X_WB = ego_track(15.0, 1.0, 5.0);
  drive(traffic, X_WB, 1.0);
  EXPECT_NEAR(traffic.against(motion_of(X_WB), ego, 8.0)[0].X_WA.back().p.x, -20.0 + 15.0 * 8.0,
              1e-6);
  traffic.let_followers_react();
  EXPECT_NEAR(traffic.actors()[0].X_WA.p.x, -5.0, 1e-9);
  const auto tracks = traffic.against(motion_of(X_WB), ego, 8.0);
  EXPECT_LT(tracks[0].X_WA.back().p.x + 2.0, X_WB.X_WA.back().p.x - 2.45);  // it stops in time
  EXPECT_NEAR(tracks[1].X_WA.back().p.x, -20.0 + 15.0 * 8.0, 1e-6);         // it has no reason
  // Until the ego does something new, it goes on as it did.
  EXPECT_NEAR(world::velocity_at(tracks[0], 2.0).x, 15.0, 0.05);
}

// One that appears behind the ego later reacts from then on.
TEST(Traffic, ARecordedFollowerThatAppearsLaterReactsToo) {
  const scenario::Recording late{{.time = 2.0, .X_WA = {{-30.0, 0.5}, 0.0}, .speed = 15.0},
                                 {.time = 9.0, .X_WA = {{75.0, 0.5}, 0.0}, .speed = 15.0}};
  const scenario::Scenario scenario = with({actor(1, late)});
  Traffic traffic(scenario);
  traffic.let_followers_react();
  const world::Track X_WB = ego_track(15.0, 1.0, 5.0);  // it rests at 37.5 m
  drive(traffic, X_WB, 9.0);
  EXPECT_LT(traffic.actors()[0].X_WA.p.x + 2.0, X_WB.X_WA.back().p.x - 2.45);
  EXPECT_EQ(traffic.actors()[0].X_WA.p.y, 0.5);
}

}  // namespace
}  // namespace saca::sim::traffic_test
