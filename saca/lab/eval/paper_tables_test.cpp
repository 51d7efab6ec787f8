#include "saca/lab/eval/paper_tables.h"

#include <gmock/gmock.h>

#include <set>

#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/sim/stepper.h"

namespace saca::eval::paper_tables_test {
namespace {

const std::filesystem::path scenarios = "scenarios";

TEST(PaperTables, HaveDifferentNames) {
  std::set<std::string_view> names;
  for (const PaperTable& table : paper_tables()) {
    EXPECT_TRUE(names.insert(table.name).second);
    EXPECT_EQ(find_paper_table(table.name), &table);
  }
  EXPECT_EQ(find_paper_table("table_9"), nullptr);
  for (const PublishedReplies& replies : published_replies()) {
    EXPECT_NE(find_paper_table(replies.table), nullptr);
  }
}

// The ego comes at 10, 11, ... 15 m/s, the truck is where it is in the shipped scene.
TEST(PaperTables, TheIntersectionIsThatOfTheScenarioAtSixSpeeds) {
  const manoeuvre::Car car = prepare::default_car();
  const auto all = encounters_of(*find_paper_table("table_2"), scenarios, car).value();
  ASSERT_EQ(all.size(), 6U);
  const auto shipped =
      scenario::load_scenario(scenarios / "intersection_t1.toml", manoeuvre::footprint(car))
          .value();
  const double at = *trigger_time(shipped, car);
  const auto scene_at = [&](const scenario::Scenario& scenario) {
    sim::Stepper stepper(scenario, car);
    while (stepper.time() < at - 1e-9) {
      stepper.advance({});
    }
    return stepper.scene();
  };
  const world::Scene as_shipped = scene_at(shipped);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].family, std::to_string(10 + i) + " m/s");
    ASSERT_TRUE(all[i].twin.has_value());
    for (const scenario::Scenario* one : {&all[i].scenario, &*all[i].twin}) {
      EXPECT_NEAR(scene_at(*one).ego.v_B.x, 10.0 + static_cast<double>(i), 1e-6);
    }
    const world::Scene scene = scene_at(all[i].scenario);
    ASSERT_EQ(scene.actors.size(), as_shipped.actors.size());
    EXPECT_NEAR(norm(scene.actors[0].X_WA.p - as_shipped.actors[0].X_WA.p), 0.0, 0.02);
  }
}

TEST(PaperTables, TheOneWayRoadIsOneConditionAndItsTwinLacksTheObstacle) {
  const manoeuvre::Car car = prepare::default_car();
  const auto all = encounters_of(*find_paper_table("table_3"), scenarios, car).value();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].scenario.actors.size(), all[0].twin->actors.size() + 1);
}

TEST(PaperTables, WithoutTheirScenariosAnErrorNamesTheFile) {
  const auto none = encounters_of(*find_paper_table("table_3"), "nowhere", prepare::default_car());
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, testing::HasSubstr("one_way.toml"));
}

}  // namespace
}  // namespace saca::eval::paper_tables_test
