#include "saca/lab/encounter/state_json.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saca::encounter::state_json_test {
namespace {

using nlohmann::json;

TEST(StateJson, TellsTheEgoInDegreesAndNoSideslipWhereItSaysNothing) {
  world::EgoState ego{.X_WB = {{3.0, -4.0}, 0.5 * std::numbers::pi},
                      .v_B = {10.0, 10.0},
                      .yaw_rate = std::numbers::pi};
  const json out = ego_json(ego, -0.25 * std::numbers::pi);
  EXPECT_EQ(out["x_m"], 3.0);
  EXPECT_EQ(out["y_m"], -4.0);
  EXPECT_DOUBLE_EQ(out["heading_deg"], 90.0);
  EXPECT_DOUBLE_EQ(out["speed_mps"], 10.0 * std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(out["sideslip_deg"], 45.0);
  EXPECT_DOUBLE_EQ(out["yaw_rate_degps"], 180.0);
  EXPECT_DOUBLE_EQ(out["steering_deg"], -45.0);
  ego.v_B = {0.1, 0.1};
  EXPECT_EQ(ego_json(ego, 0.0)["sideslip_deg"], 0.0);
}

TEST(StateJson, TellsTheRoadInTheWordsOfAScenario) {
  const json out = road_json({.X_WL = {{1.0, 2.0}, std::numbers::pi},
                              .left_beyond = world::Beyond::trees,
                              .oncoming_left = true});
  EXPECT_EQ(out["topology"], "straight");
  EXPECT_DOUBLE_EQ(out["heading_deg"], 180.0);
  EXPECT_EQ(out["left_beyond"], "trees");
  EXPECT_EQ(out["oncoming_left"], true);
  EXPECT_EQ(out["oncoming_right"], false);
}

TEST(StateJson, NamesTheActorsAndTheirOutlines) {
  scenario::Scenario scenario;
  scenario.actors.push_back({.id = 3,
                             .kind = world::ActorKind::pedestrian,
                             .footprint = {world::Shape::ellipse, 0.5, 0.6}});
  scenario.actors.push_back({.id = 1,
                             .kind = world::ActorKind::obstacle,
                             .footprint = {.shape = world::Shape::segment, .length = 8.0}});
  const json out = actor_bodies_json(scenario);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[1]["shape"], "segment");
  EXPECT_EQ(out[0], (json{{"id", "pedestrian3"},
                          {"kind", "pedestrian"},
                          {"shape", "ellipse"},
                          {"length_m", 0.5},
                          {"width_m", 0.6}}));
}

}  // namespace
}  // namespace saca::encounter::state_json_test
