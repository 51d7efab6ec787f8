#include "saca/lab/importers/traffic_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "saca/lab/scenario/motion.h"

namespace saca::importers::traffic_recording_test {
namespace {

using testing::HasSubstr;

constexpr double dt = 0.1;

recordings::Lanelet straight_lanelet(std::int64_t id, double y) {
  return {.id = id,
          .left_W = {{-100.0, y + 1.75}, {400.0, y + 1.75}},
          .right_W = {{-100.0, y - 1.75}, {400.0, y - 1.75}}};
}

/// Two lanes to the east, far from the map's origin, and a planning problem at x = 0, 15 m/s.
recordings::CommonRoad two_lanes() {
  recordings::CommonRoad file;
  file.benchmark = "TEST-1";
  file.source = "hand-made";
  file.lanelets = {straight_lanelet(1, 0.0), straight_lanelet(2, -3.5)};
  file.lanelets[0].right = recordings::Neighbour{2, true};
  file.lanelets[1].left = recordings::Neighbour{1, true};
  file.problems = {{.id = 9, .start = {.X_WO = {{0.4, 0.0}, 0.0}, .speed = 15.0}}};
  return file;
}

/// A car at constant speed along x from its first step on.
recordings::Obstacle car(std::int64_t id, double x, double y, double speed, std::int64_t first = 0,
                         std::int64_t num_states = 60) {
  recordings::Obstacle obstacle{
      .id = id, .type = "car", .footprint = {world::Shape::box, 4.5, 1.8, 0.0}};
  for (std::int64_t k = 0; k < num_states; ++k) {
    obstacle.states.push_back(
        {first + k, {{x + speed * dt * static_cast<double>(k), y}, 0.0}, speed});
  }
  return obstacle;
}

TrafficImport made_of(const recordings::CommonRoad& file, const TrafficRequest& request = {}) {
  auto made = traffic_scenario(file, request);
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return made.value();
}

std::string refusal(const recordings::CommonRoad& file, const TrafficRequest& request = {}) {
  const auto made = traffic_scenario(file, request);
  return made.has_value() ? "none" : made.error().message;
}

TEST(TrafficScenario, PutsTheEgoAtThePlanningProblem) {
  recordings::CommonRoad file = two_lanes();
  file.obstacles = {car(5, 30.0, 0.0, 12.0), car(6, 8.0, -3.5, 14.0)};
  const TrafficImport made = made_of(file);
  const scenario::Scenario& scenario = made.scenario;
  const world::EgoState ego = scenario::ego_at(scenario, 2.0);
  // The body's centre was at 0.4 m; the centre of mass is 0.1 m ahead of it; the origin is whole.
  EXPECT_NEAR(ego.X_WB.p.x, 0.5 + 30.0, 1e-9);
  EXPECT_NEAR(ego.v_B.x, 15.0, 1e-9);
  ASSERT_EQ(scenario.actors.size(), 2U);
  // Nearest first: the car beside comes to 3.5 m, the one ahead after 6 s to 12 m.
  EXPECT_EQ(made.report.actors[0].obstacle, 6);
  EXPECT_EQ(made.report.actors[0].name, "car1");
  EXPECT_EQ(made.report.actors[1].obstacle, 5);
  const world::Track ahead = scenario::actor_track(scenario, 1, dt);
  EXPECT_NEAR(world::pose_at(ahead, 3.0).p.x, 30.0 + 36.0, 2e-3);
  EXPECT_NEAR(scenario.duration, 5.9, 1e-9);
  EXPECT_NEAR(scenario.road.right_edge, -5.25, 1e-9);
  EXPECT_NEAR(scenario.road.left_edge, 1.75, 1e-9);
}

TEST(TrafficScenario, IsReadBackByTheScenariosReader) {
  recordings::CommonRoad file = two_lanes();
  file.obstacles = {car(5, 30.0, 0.0, 12.0), car(6, 8.0, -3.5, 14.0, 10)};
  for (const TrafficRequest& request : {TrafficRequest{}, TrafficRequest{.ego = 5}}) {
    const std::string text = scenario::write_scenario(made_of(file, request).scenario);
    const auto again = scenario::read_scenario(text, "again");
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_EQ(scenario::write_scenario(again.value()), text);
  }
}

TEST(TrafficScenario, LetsTheEgoDriveAsARecordedVehicleDid) {
  recordings::CommonRoad file = two_lanes();
  file.obstacles = {car(5, 30.0, 0.0, 12.0), car(6, 8.0, -3.5, 14.0)};
  const TrafficImport made = made_of(file, {.ego = 6, .from = 2.0, .after = 2.5});
  const scenario::Scenario& scenario = made.scenario;
  ASSERT_EQ(scenario.actors.size(), 1U);  // the ego is no actor
  EXPECT_EQ(made.report.from, 2.0);
  EXPECT_EQ(made.report.origin_W.x, 8.0);  // where the ego's recording begins
  const world::EgoState ego = scenario::ego_at(scenario, 1.0);
  EXPECT_NEAR(ego.X_WB.p.x + made.report.origin_W.x, 8.0 + 14.0 * 3.0 + 0.1, 2e-3);
  EXPECT_NEAR(ego.v_B.x, 14.0, 2e-3);
  EXPECT_NEAR(to_lane(scenario.road, ego.X_WB).d, 0.0, 2e-3);  // its lane, not the planned one's
  EXPECT_NEAR(scenario.duration, 3.9 + 2.5, 1e-9);
}

TEST(TrafficScenario, WhoAppearsLaterIsThereFromItsFirstSample) {
  recordings::CommonRoad file = two_lanes();
  file.obstacles = {car(5, 60.0, 0.0, 12.0, 20)};
  const TrafficImport made = made_of(file);
  EXPECT_NEAR(scenario::actor_track(made.scenario, 0, dt).start, 2.0, 1e-9);
}

TEST(TrafficScenario, CountsWhomItLeavesOut) {
  recordings::CommonRoad file = two_lanes();
  recordings::Obstacle wild = car(11, 60.0, 0.0, 12.0);
  for (std::size_t k = 20; k < wild.states.size(); ++k) {
    wild.states[k].X_WO.p.x += 1.0 * static_cast<double>((k - 20) * (k - 20));  // 200 m/s^2
    wild.states[k].speed = 12.0 + 20.0 * static_cast<double>(k - 20);
  }
  recordings::Obstacle huge = car(12, 60.0, -3.5, 12.0);
  huge.footprint.length = 60.0;
  recordings::Obstacle turned = car(13, 90.0, -3.5, 12.0);
  turned.X_OA.yaw = 1.0;
  recordings::Obstacle fast = car(14, 200.0, 0.0, 140.0);
  file.obstacles = {fast,
                    car(5, 30.0, 0.0, 12.0),
                    car(6, 31.0, 0.5, 12.0),
                    car(7, 40.0, -3.5, 9.0, 0, 4),
                    car(8, 14.0, 0.0, 15.0, 10),
                    car(9, 3000.0, 0.0, 9.0),
                    wild,
                    huge,
                    turned};
  const TrafficImport made = made_of(file);
  ASSERT_EQ(made.report.actors.size(), 1U);
  EXPECT_EQ(made.report.actors[0].obstacle, 5);
  const std::map<std::string, std::size_t> expected{
      {"moving faster than a scenario may", 1},
      {"touching a nearer one at the start", 1},
      {"seen for less than 0.5 s", 1},
      {"appearing inside the ego", 1},
      {"farther than 1 km", 1},
      {"moving harder than any tyre can", 1},
      {"of no size that a scenario may have", 1},
      {"with a shape that is turned against its motion", 1}};
  EXPECT_EQ(made.report.left_out, expected);
  file.obstacles = {car(5, 30.0, 0.0, 12.0), car(6, 8.0, -3.5, 14.0, 0, 20)};
  EXPECT_EQ(made_of(file, {.ego = 5, .from = 4.0}).report.left_out.at("gone before the start"), 1U);
}

TEST(TrafficScenario, KeepsTheNearestOnesWhenThereAreTooMany) {
  recordings::CommonRoad file = two_lanes();
  for (std::int64_t k = 0; k < 40; ++k) {
    file.obstacles.push_back(car(100 + k, 10.0 * static_cast<double>(40 - k), 0.0, 15.0));
  }
  const TrafficImport made = made_of(file);
  ASSERT_EQ(made.scenario.actors.size(), world::max_actors);
  EXPECT_EQ(made.report.left_out.at("farther than the nearest 32"), 8U);
  for (std::size_t k = 0; k < world::max_actors; ++k) {
    EXPECT_EQ(made.report.actors[k].obstacle, 139 - static_cast<std::int64_t>(k));
  }
}

// A lead that brakes with 5 m/s^2 from 2 s on, seen with an NGSIM camera's noise.
TEST(TrafficScenario, FindsTheTruthBehindTheNoise) {
  const auto way = [](double t) {
    const double b = std::clamp(t - 2.0, 0.0, 3.0);
    return 15.0 * std::min(t, 2.0) + 15.0 * b - 2.5 * b * b;
  };
  std::mt19937_64 rng(4);
  std::normal_distribution<double> normal;
  recordings::CommonRoad file = two_lanes();
  recordings::Obstacle lead = car(5, 30.0, 0.0, 15.0);
  for (std::size_t k = 0; k < lead.states.size(); ++k) {
    const double t = dt * static_cast<double>(k);
    lead.states[k].X_WO.p = {30.0 + way(t) + 0.05 * normal(rng), 0.05 * normal(rng)};
    lead.states[k].speed =
        std::max(0.0, 15.0 - 5.0 * std::clamp(t - 2.0, 0.0, 3.0) + 0.25 * normal(rng));
  }
  file.obstacles = {lead};
  const TrafficImport made = made_of(file);
  const auto& recording = std::get<scenario::Recording>(made.scenario.actors[0].motion);
  for (const scenario::Sample& sample : recording) {
    // The corners at 2 and 5 s, 5 m/s^2 high, are rounded over +-0.7 s: at most 5 / 2 * 0.7^2 / 4.
    EXPECT_NEAR(sample.X_WA.p.x, 30.0 + way(sample.time), 0.3) << sample.time;
    EXPECT_NEAR(sample.X_WA.p.y, 0.0, 0.1);
    EXPECT_NEAR(std::abs(sample.X_WA.yaw), 0.0, 0.1);
  }
  EXPECT_NEAR(made.report.hardest, 5.0, 1.5);
  EXPECT_NEAR(made.report.rms_shift, 0.05 * std::numbers::sqrt2, 0.03);
}

TEST(TrafficScenario, WhatStandsIsThereAllTheTime) {
  recordings::CommonRoad file = two_lanes();
  recordings::Obstacle box = car(20, 80.0, -3.5, 0.0, 0, 1);
  box.dynamic = false;
  box.type = "constructionZone";
  box.X_OA = {{1.0, 0.0}, 0.5};
  file.obstacles = {box};
  const TrafficImport made = made_of(file);
  EXPECT_EQ(made.report.actors[0].name, "obstacle1");
  const world::Track track = scenario::actor_track(made.scenario, 0, dt);
  EXPECT_NEAR(world::pose_at(track, 3.0).p.x, 81.0, 1e-9);
  EXPECT_NEAR(world::pose_at(track, 3.0).yaw, 0.5, 1e-4);
}

TEST(TrafficScenario, RefusesWhatCannotBePlayed) {
  recordings::CommonRoad file = two_lanes();
  file.obstacles = {car(5, 3.0, 0.5, 12.0), car(6, 40.0, -3.5, 14.0, 0, 8)};
  EXPECT_THAT(refusal(file), HasSubstr("obstacle 5 touching it"));
  EXPECT_THAT(refusal(file, {.ego = 77}), HasSubstr("got 77"));
  EXPECT_THAT(refusal(file, {.from = 3.0}), HasSubstr("want an obstacle for the ego"));
  EXPECT_THAT(refusal(file, {.ego = 6}), HasSubstr("for 1 s or more, got obstacle 6"));
  EXPECT_THAT(refusal(file, {.ego = 5, .from = 99.0}), HasSubstr("gone before the start"));
  file.problems[0].start.X_WO.p.y = 30.0;
  EXPECT_THAT(refusal(file), HasSubstr("want a start in a lanelet"));
  file.problems.clear();
  EXPECT_THAT(refusal(file), HasSubstr("planning problem"));
}

TEST(ImportCommonRoad, ReadsTheSmallFile) {
  const auto made = import_commonroad("saca/lab/recordings/testdata/commonroad_small.xml", {});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const TrafficReport& report = made.value().report;
  EXPECT_EQ(made.value().scenario.name, "saca_small_1_1_t_1");
  EXPECT_EQ(report.actors.size(), 4U);
  EXPECT_EQ(report.num_filled, 4U);  // steps 6 to 9 of the car ahead
  EXPECT_TRUE(made.value().scenario.road.oncoming_left);
  EXPECT_NEAR(made.value().scenario.road.left_edge, 5.25, 1e-9);
  EXPECT_EQ(report.ignored.at("shape/polygon"), 1U);
  const auto missing_file = import_commonroad("nowhere.xml", {});
  ASSERT_FALSE(missing_file.has_value());
  EXPECT_EQ(missing_file.error().code, Error::Code::unreadable);
}

}  // namespace
}  // namespace saca::importers::traffic_recording_test
