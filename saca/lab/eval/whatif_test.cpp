#include "saca/lab/eval/whatif.h"

#include <gmock/gmock.h>

#include "saca/base/core/units.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::whatif_test {
namespace {

using prepare::default_car;
using testing::HasSubstr;

constexpr double t1 = 5.0;  // when the paper's intersection stands as printed [s]

class Whatif : public testing::Test {
 protected:
  const scenario::Scenario scenario_ = shipped_scenario("intersection_t1");

  [[nodiscard]] Axis axis(std::string_view text) const {
    return parse_axis(text, scenario_).value();
  }
  [[nodiscard]] world::Scene scene_with(const std::string& text) const {
    const Axis changed = axis(text);
    const auto scenario =
        varied(scenario_, default_car(), t1, changed, changed.values.front()).value();
    return decision_point_at(scenario, default_car(), t1).scene;
  }
};

// As printed: truck 16 m ahead and 6.4 m to the left, ego 14 m/s.
TEST_F(Whatif, TheNominalValuesAreThoseOfThePaper) {
  const auto value = [&](std::string_view text) {
    return nominal(scenario_, default_car(), t1, axis(text)).value();
  };
  EXPECT_NEAR(value("truck.distance_m=1:2:1"), 16.0, 1e-9);
  EXPECT_NEAR(value("truck.offset_m=1:2:1"), 6.4, 1e-9);
  EXPECT_NEAR(value("truck.speed_mps=1:2:1"), 7.5, 1e-9);
  EXPECT_NEAR(value("ego.speed_mps=1:2:1"), 14.0, 1e-9);
  EXPECT_NEAR(value("ego.offset_m=0:2:1"), 0.0, 1e-9);
}

TEST_F(Whatif, OnlyWhatIsVariedChangesAtTheMoment) {
  const world::Scene before = decision_point_at(scenario_, default_car(), t1).scene;
  const world::Scene nearer = scene_with("truck.distance_m=12:12:1");
  EXPECT_NEAR(nearer.actors[0].X_WA.p.x - nearer.ego.X_WB.p.x, 12.0, 1e-9);
  EXPECT_NEAR(nearer.actors[0].X_WA.p.y, before.actors[0].X_WA.p.y, 1e-9);
  EXPECT_NEAR(nearer.ego.X_WB.p.x, before.ego.X_WB.p.x, 1e-9);

  const world::Scene faster = scene_with("truck.speed_mps=10:10:1");
  EXPECT_NEAR(norm(faster.actors[0].v_W), 10.0, 1e-9);
  EXPECT_NEAR(faster.actors[0].X_WA.p.x, before.actors[0].X_WA.p.x, 1e-9);
  EXPECT_NEAR(faster.actors[0].X_WA.p.y, before.actors[0].X_WA.p.y, 1e-9);

  const world::Scene slower = scene_with("ego.speed_mps=9:9:1");
  EXPECT_NEAR(slower.ego.v_B.x, 9.0, 1e-9);
  EXPECT_NEAR(slower.ego.X_WB.p.x, before.ego.X_WB.p.x, 1e-9);
  EXPECT_NEAR(slower.actors[0].X_WA.p.y, before.actors[0].X_WA.p.y, 1e-9);

  EXPECT_NEAR(scene_with("ego.offset_m=0.5:0.5:1").ego.X_WB.p.y, 0.5, 1e-9);
  EXPECT_EQ(scene_with("grip=0.4:0.4:1").grip, 0.4);
}

TEST_F(Whatif, AnyNumberOfTheFileCanBeVaried) {
  const auto varied_to = [&](const std::string& text) {
    const Axis changed = axis(text);
    return varied(scenario_, default_car(), t1, changed, changed.values.front()).value();
  };
  EXPECT_EQ(varied_to("road.left_edge_m=4:4:1").road.left_edge, 4.0);
  EXPECT_EQ(varied_to("duration_s=11:11:1").duration, 11.0);
  EXPECT_EQ(varied_to("perception.latency_s=0.2:0.2:1").perception.latency,
            0.2);  // not written there
  EXPECT_EQ(varied_to("truck1.mass_kg=9000:9000:1").actors[0].mass, 9'000.0);
  EXPECT_EQ(varied_to("pedestrian.length_m=0.6:0.6:1").actors[1].footprint.length, 0.6);
  const auto start_of = [](const scenario::Scenario& scenario, std::size_t actor) {
    return std::get<scenario::Script>(scenario.actors[actor].motion).start;
  };
  for (const char* text :
       {"actors.0.s_m=18:18:1", "actors.0.start.s_m=18:18:1", "truck.s_m=18:18:1"}) {
    EXPECT_EQ(axis(text).what.substr(0, 7), "truck1.") << text;
    EXPECT_EQ(start_of(varied_to(text), 0).s, 18.0) << text;
    EXPECT_EQ(start_of(varied_to(text), 1).s, start_of(scenario_, 1).s) << text;
  }
  EXPECT_EQ(std::get<scenario::EgoStart>(varied_to("ego.start.speed_mps=9:9:1").ego).speed, 9.0);
  // By its place an actor has the same numbers as by its name.
  EXPECT_EQ(axis("actors.0.distance_m=1:2:1").what, "truck1.distance_m");
  EXPECT_EQ(axis("actors.0.distance_m=1:2:1").path, "");
  EXPECT_EQ(nominal(scenario_, default_car(), t1, axis("truck1.mass_kg=1:2:1")), 12'000.0);
  EXPECT_EQ(nominal(scenario_, default_car(), t1, axis("perception.latency_s=0:1:1")),
            std::nullopt);
}

TEST(WhatifOfARecording, ANumberInAListCanBeVaried) {
  const scenario::Scenario scenario = shipped_scenario("100car_9018");
  const Axis axis = parse_axis("ego.recording.yaw_rate_degps.12=3:3:1", scenario).value();
  EXPECT_EQ(axis.key, "yaw_rate_degps");
  const auto changed = varied(scenario, default_car(), 1.0, axis, 3.0);
  ASSERT_TRUE(changed.has_value()) << changed.error().message;
  const auto& was = std::get<scenario::Recording>(scenario.ego);
  const auto& is = std::get<scenario::Recording>(changed.value().ego);
  for (std::size_t k = 0; k < was.size(); ++k) {
    EXPECT_EQ(is[k].speed, was[k].speed);
    EXPECT_NEAR(is[k].yaw_rate, k == 12 ? from_degrees(3.0) : was[k].yaw_rate, 1e-12);
  }
}

TEST_F(Whatif, ValuesThatCannotBeAreRefused) {
  const auto refused = [&](std::string_view text) {
    const Axis changed = axis(text);
    const auto scenario = varied(scenario_, default_car(), t1, changed, changed.values.front());
    return scenario.has_value() ? std::string() : scenario.error().message;
  };
  EXPECT_THAT(refused("ego.speed_mps=-1:0:1"), HasSubstr("speed_mps"));
  EXPECT_THAT(refused("grip=2:2:1"), HasSubstr("grip"));
  EXPECT_THAT(refused("pedestrian.speed_mps=1:1:1"), HasSubstr("no speed of its own"));
  EXPECT_THAT(refused("perception.latncy_s=1:1:1"), HasSubstr("did you mean 'latency_s'?"));
  EXPECT_THAT(refused("road.left_edge_m=-1:-1:1"), HasSubstr("left_edge_m: want 0.5 to 100"));
  EXPECT_THAT(refused("duration_s=2:2:1"),
              HasSubstr("duration_s=2: it ends before the policies begin, at 5 s"));
  EXPECT_EQ(refused("duration_s=5:5:1"), "");
  EXPECT_THAT(refused("actors.0.start.s_m.x=1:1:1"), HasSubstr("no number can stand there"));
}

// The follower reacts to the ego on the way; still it is where it was.
TEST(WhatifWithAFollower, ReactingDriversAreBroughtToWhereTheyWere) {
  const scenario::Scenario scenario = shipped_scenario("lead_brakes_follower");
  const double time = 4.6;
  const world::Scene before = decision_point_at(scenario, default_car(), time).scene;
  const Axis axis = parse_axis("ego.speed_mps=18:18:1", scenario).value();
  const auto slower = varied(scenario, default_car(), time, axis, 18.0);
  ASSERT_TRUE(slower.has_value()) << slower.error().message;
  const world::Scene after = decision_point_at(slower.value(), default_car(), time).scene;
  EXPECT_NEAR(after.ego.v_B.x, 18.0, 1e-9);
  EXPECT_NEAR(after.ego.X_WB.p.x, before.ego.X_WB.p.x, 0.011);
  for (std::size_t i = 0; i < before.actors.size(); ++i) {
    EXPECT_NEAR(after.actors[i].X_WA.p.x, before.actors[i].X_WA.p.x, 0.011) << i;
  }
}

TEST_F(Whatif, WhereBodiesWouldOverlapThereIsNoAnswer) {
  const Axis onto = axis("pedestrian.distance_m=0:0:1");
  const Axis beside = axis("pedestrian.offset_m=0:0:1");
  const auto near = varied(scenario_, default_car(), t1, onto, 0.0).value();
  const auto inside = varied(near, default_car(), t1, beside, 0.0).value();  // waits in our way
  const std::vector<std::optional<scenario::Scenario>> all{inside, std::nullopt, scenario_};
  const auto cells = try_cells(all, default_car(), shipped_harm(), t1, 2);
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_FALSE(cells[0].possible);
  EXPECT_FALSE(cells[1].possible);
  EXPECT_TRUE(cells[2].possible);
  EXPECT_GE(cells[2].margin, 0.0);
}

}  // namespace
}  // namespace saca::eval::whatif_test
