#include "saca/lab/encounter/danger_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "saca/lab/encounter/encounter.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/risk.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::encounter::danger_map_test {
namespace {

using danger::Edge;
using nlohmann::json;
using world::Footprint;

constexpr Footprint disc{.shape = world::Shape::ellipse, .length = 2.0, .width = 2.0};
constexpr Footprint ego{.length = 4.0, .width = 1.8};

/// A model whose V is what the test says, for a disc at rest: points every 2 m and 10 m/s.
danger::DangerModel told(const Footprint& body, double half,
                         const std::function<double(const danger::State&)>& value) {
  constexpr double pi = std::numbers::pi;
  const int points = static_cast<int>(half) + 1;
  const danger::Grid grid{
      {{.name = "x", .first = -half, .last = half, .points = points},
       {.name = "y", .first = -half, .last = half, .points = points},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 30.0, .points = 4}}};
  std::vector<float> values(danger::num_cells(grid));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>(value(danger::state_at(grid, i)));
  }
  return {
      danger::Avoidance{},
      body,
      {{disc, 0.0, danger::View::obstacle, std::make_shared<danger::ValueTable>(grid, values)}}};
}

/// Linear, so that it is exact between points too.
double slope(Vec2 p_O, double speed) {
  return 0.5 - 0.1 * p_O.x + 0.2 * p_O.y + 0.3 * speed;
}
danger::DangerModel sloping(double half) {
  return told(ego, half, [](const danger::State& at) { return slope({at[0], at[1]}, at[3]); });
}

world::Scene meeting(Vec2 ego_W) {
  world::Scene scene{.time = 1.5, .ego_footprint = ego, .ego_mass = 1'500.0};
  scene.ego.X_WB = {ego_W, 0.3};
  scene.ego.v_B = {12.0, 0.0};
  world::Actor wreck{.id = 1, .footprint = disc, .mass = 1'500.0, .X_WA = {{30.0, -4.0}, 2.0}};
  scene.actors.push_back(wreck);
  return scene;
}

TEST(DangerMap, HoldsTheValueOfTheEgoAtEachPoint) {
  const danger::DangerModel model = sloping(60.0);
  const world::Scene scene = meeting({10.0, 5.0});
  const auto map = danger_map(scene, scene.actors[0], model);
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->time, 1.5);
  EXPECT_DOUBLE_EQ(map->ego_speed, 12.0);
  EXPECT_NEAR(map->ego_yaw, 0.3, 1e-12);
  ASSERT_EQ(map->values.size(), static_cast<std::size_t>(map->rows * map->columns));
  for (int row = 0; row < map->rows; ++row) {
    for (int column = 0; column < map->columns; ++column) {
      const Vec2 p_W = scene.actors[0].X_WA * (map->X_AM * map->point(column, row));
      const Vec2 p_O = rotated(p_W - Vec2{30.0, -4.0}, -2.0);
      const auto& value = map->values[map->index(column, row)];
      ASSERT_TRUE(value.has_value());
      ASSERT_NEAR(*value, slope(p_O, 12.0), 1e-5) << row << ' ' << column;  // tables are floats
    }
  }
}

TEST(DangerMap, ReachesAroundBothAndStaysSmall) {
  const danger::DangerModel model = sloping(120.0);
  for (const Vec2 ego_W : {Vec2{30.0, -4.0}, Vec2{27.0, -4.0}, Vec2{10.0, 5.0}, Vec2{80.0, 30.0}}) {
    const world::Scene scene = meeting(ego_W);
    const auto map = danger_map(scene, scene.actors[0], model);
    ASSERT_TRUE(map.has_value());
    EXPECT_LE(map->values.size(), 1'400U);
    EXPECT_GE(map->values.size(), 900U);
    const Vec2 ego_M = inverse(map->X_AM) * (inverse(scene.actors[0].X_WA) * ego_W);
    const Vec2 last_M = map->point(map->columns - 1, map->rows - 1);
    for (const Vec2 p : {ego_M, Vec2{0.0, 0.0}}) {
      EXPECT_GT(p.x, map->first_M.x + 3.0);
      EXPECT_GT(p.y, map->first_M.y + 3.0);
      EXPECT_LT(p.x, last_M.x - 3.0);
      EXPECT_LT(p.y, last_M.y - 3.0);
    }
  }
}

TEST(DangerMap, IsOfTheTablesOnly) {
  const danger::DangerModel small = sloping(20.0);
  const world::Scene near = meeting({20.0, -10.0});
  const auto map = danger_map(near, near.actors[0], small);
  ASSERT_TRUE(map.has_value());
  for (int row = 0; row < map->rows; ++row) {
    for (int column = 0; column < map->columns; ++column) {
      const Vec2 p_W = near.actors[0].X_WA * (map->X_AM * map->point(column, row));
      const Vec2 p_O = rotated(p_W - Vec2{30.0, -4.0}, -2.0);
      EXPECT_EQ(map->values[map->index(column, row)].has_value(),
                std::abs(p_O.x) <= 20.0 && std::abs(p_O.y) <= 20.0);
    }
  }
  const world::Scene far = meeting({-10.0, 5.0});
  EXPECT_FALSE(danger_map(far, far.actors[0], small).has_value());
  const danger::DangerModel without({}, ego, {});
  EXPECT_FALSE(danger_map(near, near.actors[0], without).has_value());
}

/// `count` frames of 20 ms with car1 and car2, both within the tables.
Record driving(int count) {
  Record record;
  for (int k = 0; k < count; ++k) {
    Frame frame{.phase = Phase::driving, .scene = meeting({10.0, 5.0})};
    frame.scene.time = 0.02 * k;
    world::Actor second = frame.scene.actors[0];
    second.id = 2;
    second.X_WA.p.y += 10.0;
    frame.scene.actors.push_back(second);
    record.frames.push_back(frame);
  }
  return record;
}

TEST(DangerMaps, AreOfTheTriggersThreatOrElseOfTheLargestRisk) {
  const danger::DangerModel model = sloping(60.0);
  Record record = driving(2);
  EXPECT_FALSE(danger_maps(record, model).has_value());  // nobody threatens
  record.previews.emplace_back();
  preview::Situation& situation = record.previews[0].situation;
  situation.scene_at_trigger = record.frames[0].scene;
  situation.risks.resize(2);
  situation.risks[0].risk = 0.4;
  situation.risks[1].risk = 0.6;
  EXPECT_EQ(danger_maps(record, model).value().actor, "car2");
  situation.risks[0] = {.risk = 0.6, .value = -3.0};
  situation.risks[1] = {.risk = 0.6, .value = -4.0};
  EXPECT_EQ(danger_maps(record, model).value().actor, "car1");
  situation.risks[0] = {.risk = 0.0, .value = 0.0, .judged = false};  // who is behind
  situation.risks[1] = {.risk = 0.0, .value = -40.0};
  EXPECT_EQ(danger_maps(record, model).value().actor, "car2");
  situation.risks[1].judged = false;
  EXPECT_FALSE(danger_maps(record, model).has_value());
  situation.risks[0] = {.risk = 0.6, .value = -3.0};
  record.threat = "car2";
  EXPECT_EQ(danger_maps(record, model).value().actor, "car2");
  record.threat = "car3";  // never seen
  EXPECT_EQ(danger_maps(record, model).value().actor, "car1");
}

TEST(DangerMaps, AreSpreadOverAllOfALongRun) {
  const danger::DangerModel model = sloping(60.0);
  Record record = driving(1'001);  // 20 s
  for (int k = 0; k < 100; ++k) {
    record.frames[static_cast<std::size_t>(k)].phase = Phase::recorded;
  }
  record.threat = "car1";
  const DangerMaps maps = danger_maps(record, model).value();
  EXPECT_LE(maps.maps.size(), 16U);
  EXPECT_GE(maps.maps.size(), 15U);
  EXPECT_NEAR(maps.maps.front().time, 2.0, 1e-9);  // not before T2
  EXPECT_GE(maps.maps.back().time + maps.interval, 20.0 - 16 * 0.02);
  EXPECT_NEAR(maps.interval, 18.0 / 16.0, 1e-9);
}

/// A run towards a disc, whose V is taken to be how deep two discs overlap.
class DangerMapsTest : public testing::Test {
 protected:
  DangerMapsTest() {
    scenario_.ego = scenario::EgoStart{.pose = {}, .speed = 9.0};
    scenario_.actors.push_back(
        {.id = 1,
         .kind = world::ActorKind::pedestrian,
         .footprint = disc,
         .mass = 75.0,
         .motion = scenario::Script{.start = {.s = 40.0}, .behaviour = scenario::Behaviour::hold}});
  }
  [[nodiscard]] encounter::Setup setup(const danger::DangerModel* danger) {
    return {.scenario = &scenario_,
            .car = &car_,
            .harm = &harm_,
            .intent = &intent_,
            .danger = danger,
            .clock = &clock_};
  }

  manoeuvre::Car car_ = prepare::default_car();
  const intent::Model& intent_ = intent::shipped_model();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  scenario::Scenario scenario_{
      .name = "disc", .title = "A disc", .car = "x", .grip = 0.9, .duration = 4.0};
  SteadyClock clock_;
  Silence quiet_;
  danger::DangerModel model_ = told(manoeuvre::footprint(car_), 60.0, [](const danger::State& at) {
    return 2.0 - std::hypot(at[0], at[1]);
  });
};

/// Between a map's points; none of the four may be unknown.
double between_points(const DangerMap& map, Vec2 p_M) {
  const Vec2 at = (1.0 / map.step) * (p_M - map.first_M);
  const int column = static_cast<int>(at.x);
  const int row = static_cast<int>(at.y);
  const auto value = [&](int c, int r) { return map.values.at(map.index(c, r)).value(); };
  return std::lerp(std::lerp(value(column, row), value(column + 1, row), at.x - column),
                   std::lerp(value(column, row + 1), value(column + 1, row + 1), at.x - column),
                   at.y - row);
}

TEST_F(DangerMapsTest, AgreeWithTheRiskAlongTheRun) {
  const Record record = run(setup(&model_), quiet_).value();
  ASSERT_TRUE(record.danger_maps.has_value());
  const DangerMaps& maps = *record.danger_maps;
  EXPECT_EQ(maps.actor, "pedestrian1");
  ASSERT_GE(maps.maps.size(), 8U);  // some 3 s until it rests
  ASSERT_LE(maps.maps.size(), 16U);
  double last = -1.0;
  for (const DangerMap& map : maps.maps) {
    EXPECT_TRUE(last < 0.0 || map.time >= last + maps.interval - 1e-6);
    last = map.time;
    const auto frame = std::find_if(record.frames.begin(), record.frames.end(),
                                    [&](const Frame& one) { return one.scene.time == map.time; });
    ASSERT_NE(frame, record.frames.end());
    EXPECT_GT(norm(frame->scene.ego.v_B), 0.5);
    const world::Actor& actor = frame->scene.actors[0];
    const Vec2 ego_M = inverse(map.X_AM) * (inverse(actor.X_WA) * frame->scene.ego.X_WB.p);
    // Straight lines over the cone's 2 m cells and over the map's steps, away from its tip.
    EXPECT_NEAR(between_points(map, ego_M), obstacle_risk(frame->scene, actor, model_).value, 0.05);
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.columns; ++column) {
        const double distance = norm(map.point(column, row));
        const auto& value = map.values[map.index(column, row)];
        ASSERT_TRUE(value.has_value());
        if (distance < 0.5 || distance > 3.0) {  // of 2 m, give or take the cells
          EXPECT_EQ(*value >= 0.0, distance < 2.0) << distance;
        }
      }
    }
  }
}

TEST_F(DangerMapsTest, AreNoneWithoutTables) {
  EXPECT_FALSE(run(setup(nullptr), quiet_).value().danger_maps.has_value());
  const danger::DangerModel without({}, ego, {});
  const Record record = run(setup(&without), quiet_).value();
  EXPECT_FALSE(record.danger_maps.has_value());
  EXPECT_TRUE(json::parse(record_json(setup(&without), record))["danger_maps"].is_null());
}

TEST_F(DangerMapsTest, AreWrittenInTenthsRoundedDown) {
  Record record = run(setup(&model_), quiet_).value();
  EXPECT_LT(json::parse(record_json(setup(&model_), record))["danger_maps"].dump(1).size(),
            150'000U);
  record.danger_maps = {.actor = "car7", .interval = 0.5};
  record.danger_maps->maps.push_back({.time = 2.0,
                                      .ego_speed = 9.0,
                                      .ego_yaw = std::numbers::pi / 2.0,
                                      .X_AM = {{1.0, -2.0}, -std::numbers::pi},
                                      .first_M = {-3.0, -4.0},
                                      .step = 0.75,
                                      .columns = 3,
                                      .rows = 2,
                                      .values = {-12.34, -0.01, 0.0, std::nullopt, 0.09, 1.26}});
  const json out = json::parse(record_json(setup(&model_), record))["danger_maps"];
  EXPECT_EQ(out["actor"], "car7");
  EXPECT_EQ(out["interval_s"], 0.5);
  ASSERT_EQ(out["maps"].size(), 1U);
  const json& map = out["maps"][0];
  EXPECT_EQ(map["rows"], json::array({"-124 -1 0", ". 0 12"}));
  EXPECT_EQ(map["t_s"], 2.0);
  EXPECT_EQ(map["speed_mps"], 9.0);
  EXPECT_DOUBLE_EQ(map["course_deg"].get<double>(), 90.0);
  EXPECT_EQ(map["x_m"], 1.0);
  EXPECT_EQ(map["y_m"], -2.0);
  EXPECT_DOUBLE_EQ(map["heading_deg"].get<double>(), -180.0);
  EXPECT_EQ(map["first_x_m"], -3.0);
  EXPECT_EQ(map["first_y_m"], -4.0);
  EXPECT_EQ(map["step_m"], 0.75);
}

}  // namespace
}  // namespace saca::encounter::danger_map_test
