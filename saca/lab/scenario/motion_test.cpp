#include "saca/lab/scenario/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::scenario::motion_test {
namespace {

constexpr double step = 0.01;

Scenario with(const std::variant<Script, Recording>& motion) {
  Scenario scenario;
  scenario.duration = 6.0;
  ScenarioActor actor;
  actor.footprint = {world::Shape::box, 4.6, 1.8, 0.0};
  actor.motion = motion;
  scenario.actors.push_back(actor);
  return scenario;
}

Script script(double speed, Behaviour behaviour, double acceleration = 0.0, double from = 0.0) {
  return {.start = {10.0, 1.0, 0.0},
          .speed = speed,
          .behaviour = behaviour,
          .acceleration = acceleration,
          .from = from};
}

double x_at(const Scenario& scenario, double time) {
  return pose_at(actor_track(scenario, 0, step), time).p.x;
}

TEST(ActorTrack, HoldsOrGoesOn) {
  EXPECT_DOUBLE_EQ(x_at(with(script(0.0, Behaviour::hold)), 5.0), 10.0);
  EXPECT_NEAR(x_at(with(script(8.0, Behaviour::constant_velocity)), 5.0), 50.0, 1e-12);
}

TEST(ActorTrack, AcceleratesUntilRest) {
  // v^2 / 2a = 64 / 8 = 8 m, reached after 2 s.
  const Scenario slowing = with(script(8.0, Behaviour::accelerate, -4.0));
  EXPECT_NEAR(x_at(slowing, 1.0), 10.0 + 8.0 - 2.0, 1e-12);
  EXPECT_NEAR(x_at(slowing, 2.0), 18.0, 1e-12);
  EXPECT_NEAR(x_at(slowing, 5.0), 18.0, 1e-12);
  EXPECT_NEAR(x_at(with(script(1.0, Behaviour::accelerate, 2.0)), 3.0), 10.0 + 3.0 + 9.0, 1e-12);
}

TEST(ActorTrack, BrakesWhenToldTo) {
  // 1.5 s at 8 m/s, then 8 m of braking.
  const Scenario scenario = with(script(8.0, Behaviour::brake, 4.0, 1.5));
  EXPECT_NEAR(x_at(scenario, 1.5), 22.0, 1e-12);
  EXPECT_NEAR(x_at(scenario, 6.0), 30.0, 1e-12);
  EXPECT_GT(velocity_at(actor_track(scenario, 0, step), 1.0).x, 7.9);
  EXPECT_EQ(velocity_at(actor_track(scenario, 0, step), 5.0).x, 0.0);
}

// From 2 s on at 2 m/s^2 to 12 m/s, reached after 2 s and 20 m more.
TEST(ActorTrack, AcceleratesFromATimeUntilASpeed) {
  Script faster = script(8.0, Behaviour::accelerate, 2.0, 2.0);
  faster.until_speed = 12.0;
  EXPECT_NEAR(x_at(with(faster), 2.0), 10.0 + 16.0, 1e-12);
  EXPECT_NEAR(x_at(with(faster), 4.0), 10.0 + 16.0 + 20.0, 1e-12);
  EXPECT_NEAR(x_at(with(faster), 6.0), 10.0 + 16.0 + 20.0 + 24.0, 1e-12);
  Script slower = script(8.0, Behaviour::accelerate, -4.0, 1.0);
  slower.until_speed = 4.0;  // after 1 s and 6 m
  EXPECT_NEAR(x_at(with(slower), 5.0), 10.0 + 8.0 + 6.0 + 12.0, 1e-12);
}

Script lane_change(double heading = 0.0) {
  Script change = script(10.0, Behaviour::lane_change, 0.0, 1.0);
  change.start.heading = heading;
  change.to_d = 4.5;  // 3.5 m to the left of where it starts
  change.takes = 2.0;
  return change;
}

// At constant speed the quintic in the way is one in time: 10 x^3 - 15 x^4 + 6 x^5.
TEST(ActorTrack, ChangesTheLaneSmoothly) {
  const world::Track track = actor_track(with(lane_change()), 0, step);
  EXPECT_EQ(pose_at(track, 1.0).p.y, 1.0);
  const double x = 0.25;
  EXPECT_NEAR(pose_at(track, 1.5).p.y, 1.0 + 3.5 * x * x * x * (10.0 - 15.0 * x + 6.0 * x * x),
              1e-9);
  EXPECT_NEAR(pose_at(track, 2.0).p.y, 1.0 + 1.75, 1e-9);
  EXPECT_NEAR(pose_at(track, 3.0).p.y, 4.5, 1e-9);
  EXPECT_NEAR(pose_at(track, 3.0).p.x, 10.0 + 30.0, 1e-9);
  EXPECT_EQ(pose_at(track, 6.0).p.y, 4.5);
  EXPECT_NEAR(std::tan(pose_at(track, 2.0).yaw), steepest_slope(lane_change()), 1e-9);
  for (double time = 0.0; time < 5.0; time += 0.05) {  // the body heads along its path
    const Vec2 v_W = velocity_at(track, time + 0.005);
    EXPECT_NEAR(std::atan2(v_W.y, v_W.x), pose_at(track, time + 0.005).yaw, 1e-3) << time;
  }
}

TEST(ActorTrack, ChangesTheLaneAgainstItsDirection) {
  const Pose at = pose_at(actor_track(with(lane_change(std::numbers::pi)), 0, step), 2.0);
  EXPECT_NEAR(at.p.x, 10.0 - 20.0, 1e-9);
  EXPECT_NEAR(at.p.y, 2.75, 1e-9);
  EXPECT_GT(wrap_angle(std::numbers::pi - at.yaw), 0.1);  // it heads back and to y > 0
}

// It brakes with 10 m/s^2 from 10 m/s: at rest after 1 s and 5 m, by then across.
TEST(ActorTrack, ALaneChangeWithBrakingEndsAtRest) {
  Script change = lane_change();
  change.acceleration = 10.0;
  const world::Track track = actor_track(with(change), 0, step);
  EXPECT_NEAR(pose_at(track, 2.0).p.x, 10.0 + 10.0 + 5.0, 1e-9);
  EXPECT_NEAR(pose_at(track, 2.0).p.y, 4.5, 1e-9);
  EXPECT_EQ(norm(velocity_at(track, 3.0)), 0.0);
}

// The way along a curve is that at the offset where it is driven: 10 m/s all along.
TEST(ActorTrack, ALaneChangeOnACurveKeepsItsSpeedAlongTheLane) {
  Scenario scenario = with(lane_change());
  scenario.road.curvature = 1.0 / 60.0;
  const world::Track track = actor_track(scenario, 0, step);
  for (double time = 0.0; time < 6.0; time += 0.25) {
    const world::LanePose at = to_lane(scenario.road, pose_at(track, time + 0.005));
    const double along = norm(velocity_at(track, time)) * std::cos(at.heading);
    EXPECT_NEAR(along, 10.0, 0.01 * 10.0) << time;  // of (d / radius)^2
  }
}

TEST(ActorTrack, WhoWalksStopsGoesOnOrRuns) {
  Script walk = script(1.5, Behaviour::walk, 0.0, 2.0);
  walk.start.heading = std::numbers::pi / 2.0;
  walk.run_speed = 4.5;
  const auto y_at = [&](Deed then, double time) {
    walk.then = then;
    return pose_at(actor_track(with(walk), 0, step), time).p.y - walk.start.d;
  };
  EXPECT_NEAR(y_at(Deed::go_on, 4.0), 6.0, 1e-12);
  EXPECT_NEAR(y_at(Deed::stop, 6.0), 3.0 + 1.5 * 1.5 / (2.0 * 3.0), 1e-12);
  EXPECT_NEAR(y_at(Deed::run, 4.0), 3.0 + 3.0 + 4.5, 1e-12);  // 1 s at 3 m/s on average
}

TEST(ActorTrack, ChanceShiftsDelaysAndScales) {
  const Scenario scenario = with(script(8.0, Behaviour::brake, 4.0, 1.5));
  Chance chance;
  chance.actors[0] = {.ahead = 0.3, .aside = -0.2, .delay = 0.5, .strength = 2.0};
  const world::Track track = actor_track(scenario, 0, step, chance);
  EXPECT_NEAR(track.X_WA[0].p.x, 10.3, 1e-12);
  EXPECT_NEAR(track.X_WA[0].p.y, 0.8, 1e-12);
  // 2 s at 8 m/s, then 4 m at 8 m/s^2.
  EXPECT_NEAR(pose_at(track, 6.0).p.x, 10.3 + 16.0 + 4.0, 1e-12);
  chance.actors[0] = {.delay = -9.0};
  EXPECT_NEAR(pose_at(actor_track(scenario, 0, step, chance), 6.0).p.x, 10.0 + 8.0, 1e-12);
}

// A fifth harder than written would be 9.6 m/s^2; a real grip of 0.8 times 0.9 gives 7.06: from
// 8 m/s, 4.53 m. In a time that runs 1.1 times as fast the same road gives as much.
TEST(ActorTrack, NobodyBrakesHarderThanTheRoadAllows) {
  Scenario scenario = with(script(8.0, Behaviour::brake, 8.0));
  scenario.grip = 0.9;
  Chance chance;
  chance.car.grip = 0.8;
  chance.actors[0].strength = 1.2;
  EXPECT_NEAR(pose_at(actor_track(scenario, 0, step, chance), 6.0).p.x,
              10.0 + 64.0 / (2.0 * 0.9 * 0.8 * 9.80665), 1e-9);
  chance.actors[0].speed = 1.1;
  EXPECT_NEAR(pose_at(actor_track(scenario, 0, step, chance), 6.0).p.x,
              10.0 + 1.21 * 64.0 / (2.0 * 0.9 * 0.8 * 9.80665), 1e-3);
  scenario.grip = 0.5;  // as written it is played, whatever the road
  EXPECT_NEAR(pose_at(actor_track(scenario, 0, step), 6.0).p.x, 10.0 + 4.0, 1e-12);
  std::get<Script>(scenario.actors[0].motion).behaviour = Behaviour::accelerate;
  std::get<Script>(scenario.actors[0].motion).acceleration = -4.0;
  chance = {};
  chance.actors[0].strength = 1.5;
  EXPECT_NEAR(pose_at(actor_track(scenario, 0, step, chance), 6.0).p.x,
              10.0 + 64.0 / (2.0 * 0.5 * 9.80665), 1e-9);
}

TEST(ActorTrack, ChanceRunsThroughAMotionFasterFromATimeOn) {
  Chance chance;
  chance.from = 2.0;
  chance.actors[0].speed = 1.5;
  const Scenario scenario = with(script(8.0, Behaviour::brake, 3.5, 3.0));
  const world::Track asked = actor_track(scenario, 0, step);
  const world::Track drawn = actor_track(scenario, 0, step, chance);
  for (const double time : {0.5, 2.0, 2.5, 3.5}) {
    const double own = time < 2.0 ? time : 2.0 + 1.5 * (time - 2.0);
    EXPECT_NEAR(pose_at(drawn, time).p.x, pose_at(asked, own).p.x, 1e-3) << time;
  }
  const Recording late{{3.0, {{10.0, 0.0}, 0.0}, 5.0, 0.0}, {5.0, {{20.0, 0.0}, 0.0}, 5.0, 0.0}};
  EXPECT_NEAR(actor_track(with(late), 0, step, chance).start, 2.0 + 1.0 / 1.5, 1e-12);
}

TEST(ActorTrack, ChanceChoosesByTheProbabilities) {
  Script walk = script(1.5, Behaviour::walk, 0.0, 1.0);
  walk.run_speed = 3.0;
  walk.then = Deed::go_on;
  Chance chance;
  const auto way = [&](std::optional<double> choice) {
    chance.actors[0].choice = choice;
    return pose_at(actor_track(with(walk), 0, step, chance), 5.0).p.x - 10.0;
  };
  EXPECT_NEAR(way(0.1), 7.5, 1e-12);  // without probabilities it does what is written
  walk.chance_stop = 0.25;
  walk.chance_run = 0.5;
  EXPECT_LT(way(0.24), 2.0);
  EXPECT_GT(way(0.26), 12.0);
  EXPECT_GT(way(0.74), 12.0);
  EXPECT_NEAR(way(0.76), 7.5, 1e-12);
  EXPECT_NEAR(way(std::nullopt), 7.5, 1e-12);
}

TEST(ActorTrack, WhoReactsHasNone) {
  const Scenario scenario = with(script(8.0, Behaviour::follow));
  EXPECT_TRUE(reacts(scenario.actors[0]));
  EXPECT_THROW((void)actor_track(scenario, 0, step), ContractViolation);
  EXPECT_EQ(start_pose(scenario, 0).p.x, 10.0);
}

TEST(ActorTrack, CrossesTheRoadStraight) {
  Script crossing = script(7.5, Behaviour::constant_velocity);
  crossing.start = {55.0, 43.0, -std::numbers::pi / 2.0};
  const Pose end = pose_at(actor_track(with(crossing), 0, step), 4.0);
  EXPECT_NEAR(end.p.x, 55.0, 1e-9);
  EXPECT_NEAR(end.p.y, 13.0, 1e-9);
}

// On a circle of radius 50 m about (0, 50), an actor 1 m to the left runs on 49 m: its way is the
// arc 49 * angle.
TEST(ActorTrack, FollowsACurvedLane) {
  Scenario scenario = with(script(7.0, Behaviour::constant_velocity));
  scenario.road.curvature = 1.0 / 50.0;
  const world::Track track = actor_track(scenario, 0, step);
  for (const double time : {0.0, 2.0, 5.0}) {
    const Pose at = pose_at(track, time);
    EXPECT_NEAR(std::hypot(at.p.x, at.p.y - 50.0), 49.0, 1e-4);  // chords of 7 cm
    EXPECT_NEAR(at.yaw, 10.0 / 50.0 + 7.0 * time / 49.0, 1e-9);
  }
}

TEST(ActorTrack, GoesAgainstTheLane) {
  Script oncoming = script(7.0, Behaviour::constant_velocity);
  oncoming.start = {50.0, 3.5, std::numbers::pi};
  const Pose at = pose_at(actor_track(with(oncoming), 0, step), 2.0);
  EXPECT_NEAR(at.p.x, 36.0, 1e-9);
  EXPECT_NEAR(at.p.y, 3.5, 1e-9);
}

TEST(ActorTrack, FollowsItsRecordingAndThenItsLastSpeed) {
  const Recording moving{{1.0, {{10.0, 0.0}, 0.0}, 5.0, 0.0}, {2.0, {{16.0, 1.0}, 0.0}, 7.0, 0.0}};
  const world::Track track = actor_track(with(moving), 0, step);
  EXPECT_EQ(track.start, 1.0);  // it is not there before
  EXPECT_NEAR(pose_at(track, 1.5).p.x, 13.0, 1e-9);
  EXPECT_NEAR(pose_at(track, 1.5).p.y, 0.5, 1e-9);
  EXPECT_NEAR(pose_at(track, 4.0).p.x, 16.0 + 14.0, 1e-9);
  EXPECT_GE(end_time(track), 6.0);
  EXPECT_LT(end_time(track), 6.0 + step);
}

TEST(ActorTrack, StaysWhereItStopped) {
  const Recording stopping{{0.0, {{10.0, 0.0}, 0.0}, 1.0, 0.0},
                           {1.0, {{10.5, 0.0}, 0.0}, 0.1, 0.0}};
  EXPECT_NEAR(pose_at(actor_track(with(stopping), 0, step), 6.0).p.x, 10.5, 1e-12);
}

TEST(ActorTrack, RefusesWhatIsNotThere) {
  const Scenario scenario = with(script(1.0, Behaviour::constant_velocity));
  EXPECT_THROW((void)actor_track(scenario, 1, step), ContractViolation);
  EXPECT_THROW((void)actor_track(scenario, 0, 0.0), ContractViolation);
}

TEST(EgoAt, IsInterpolatedBetweenSamples) {
  Scenario scenario;
  scenario.ego = Recording{{0.0, {{0.0, 0.0}, 0.0}, 10.0, 0.0},
                           {0.1, {{1.0, 0.0}, 0.02}, 9.6, 0.2},
                           {0.2, {{1.9, 0.1}, 0.04}, 9.0, 0.2}};
  const world::EgoState ego = ego_at(scenario, 0.05);
  EXPECT_NEAR(ego.X_WB.p.x, 0.5, 1e-12);
  EXPECT_NEAR(ego.X_WB.yaw, 0.01, 1e-12);
  EXPECT_NEAR(ego.v_B.x, 9.8, 1e-12);
  EXPECT_NEAR(ego.a_B.x, -4.0, 1e-12);
  EXPECT_NEAR(ego.yaw_rate, 0.1, 1e-12);
  EXPECT_NEAR(ego_at(scenario, 1.2).v_B.x, 9.0, 1e-12);
  EXPECT_NEAR(ego_at(scenario, 1.2).X_WB.p.x, 1.9 + 9.0 * std::cos(0.04), 1e-12);
}

TEST(EgoAt, GoesOnAlongItsLane) {
  Scenario scenario;
  scenario.road.curvature = 0.01;
  scenario.ego = EgoStart{{0.0, 0.0, 0.0}, 20.0};
  const world::EgoState ego = ego_at(scenario, 3.0);  // 60 m on a circle of 100 m
  EXPECT_NEAR(ego.X_WB.yaw, 0.6, 1e-12);
  EXPECT_NEAR(ego.X_WB.p.x, 100.0 * std::sin(0.6), 1e-9);
  EXPECT_NEAR(ego.yaw_rate, 0.2, 1e-12);
  EXPECT_NEAR(ego.a_B.y, 4.0, 1e-12);  // v^2 / r
  EXPECT_THROW((void)ego_at(scenario, std::numeric_limits<double>::quiet_NaN()), ContractViolation);
}

}  // namespace
}  // namespace saca::scenario::motion_test
