#include "saca/eval/whatif.h"

#include <gmock/gmock.h>

#include "saca/eval/scenes_for_test.h"

namespace saca::eval::whatif_test {
namespace {

using manoeuvre::default_car;
using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double t1 = 5.0;  // when the paper's intersection stands as printed [s]

class Whatif : public testing::Test {
 protected:
  const sim::Scenario scenario_ = shipped_scenario("intersection_t1");

  [[nodiscard]] Axis axis(std::string_view text) const {
    return parse_axis(text, scenario_).value();
  }
  [[nodiscard]] std::string complaint(std::string_view text) const {
    const auto axis = parse_axis(text, scenario_);
    return axis.has_value() ? std::string() : axis.error().message;
  }
  [[nodiscard]] world::Scene scene_with(const std::string& text) const {
    const Axis changed = axis(text);
    const auto scenario =
        varied(scenario_, default_car(), t1, changed, changed.values.front()).value();
    return moment_at(scenario, default_car(), t1).scene;
  }
};

TEST_F(Whatif, AnAxisNamesBodyKeyAndValues) {
  const Axis truck = axis("truck.distance_m=10:11:0.25");
  EXPECT_EQ(truck.what, "truck1.distance_m");
  EXPECT_THAT(truck.values, ElementsAre(10.0, 10.25, 10.5, 10.75, 11.0));
  EXPECT_THAT(axis("ego.speed_mps=8:8:1").values, ElementsAre(8.0));
  EXPECT_THAT(axis("grip=0.3:0.9:0.2").values,
              ElementsAre(0.3, 0.5, DoubleNear(0.7, 1e-12), DoubleNear(0.9, 1e-12)));
}

TEST_F(Whatif, AnAxisThatCannotBeMeantIsRefused) {
  EXPECT_THAT(complaint("truck.distance_m"), HasSubstr("want BODY.KEY=FROM:TO:STEP"));
  EXPECT_THAT(complaint("tram.distance_m=1:2:1"),
              AllOf(HasSubstr("truck1"), HasSubstr("pedestrian1"), HasSubstr("got \"tram\"")));
  EXPECT_THAT(complaint("truck.colour=1:2:1"), HasSubstr("distance_m, offset_m or speed_mps"));
  EXPECT_THAT(complaint("ego.distance_m=1:2:1"), HasSubstr("of the ego"));
  EXPECT_THAT(complaint("grip=0.9:0.3:0.1"), HasSubstr("TO >= FROM"));
  EXPECT_THAT(complaint("grip=0.3:0.9:0"), HasSubstr("STEP > 0"));
  EXPECT_THAT(complaint("grip=0.3:nan:0.1"), HasSubstr("FROM:TO:STEP"));
  EXPECT_THAT(complaint("grip=0:1:1e-9"), HasSubstr("at most 400 values"));
}

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
  const world::Scene before = moment_at(scenario_, default_car(), t1).scene;
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

TEST_F(Whatif, ValuesThatCannotBeAreRefused) {
  const auto refused = [&](std::string_view text) {
    const Axis changed = axis(text);
    const auto scenario = varied(scenario_, default_car(), t1, changed, changed.values.front());
    return scenario.has_value() ? std::string() : scenario.error().message;
  };
  EXPECT_THAT(refused("ego.speed_mps=-1:0:1"), HasSubstr("speed_mps"));
  EXPECT_THAT(refused("grip=2:2:1"), HasSubstr("grip"));
  EXPECT_THAT(refused("pedestrian.speed_mps=1:1:1"), HasSubstr("no speed of its own"));
}

// The follower reacts to the ego on the way; still it is where it was.
TEST(WhatifWithAFollower, ReactingDriversAreBroughtToWhereTheyWere) {
  const sim::Scenario scenario = shipped_scenario("lead_brakes_follower");
  const double time = 4.6;
  const world::Scene before = moment_at(scenario, default_car(), time).scene;
  const Axis axis = parse_axis("ego.speed_mps=18:18:1", scenario).value();
  const auto slower = varied(scenario, default_car(), time, axis, 18.0);
  ASSERT_TRUE(slower.has_value()) << slower.error().message;
  const world::Scene after = moment_at(slower.value(), default_car(), time).scene;
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
  const std::vector<std::optional<sim::Scenario>> all{inside, std::nullopt, scenario_};
  const auto cells = try_cells(all, default_car(), shipped_harm(), t1, 2);
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_FALSE(cells[0].possible);
  EXPECT_FALSE(cells[1].possible);
  EXPECT_TRUE(cells[2].possible);
  EXPECT_GE(cells[2].margin, 0.0);
}

}  // namespace
}  // namespace saca::eval::whatif_test
