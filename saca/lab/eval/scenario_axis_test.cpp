#include "saca/lab/eval/scenario_axis.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::scenario_axis_test {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

class ScenarioAxis : public testing::Test {
 protected:
  const scenario::Scenario scenario_ = shipped_scenario("intersection_t1");

  [[nodiscard]] Axis axis(std::string_view text) const {
    return parse_axis(text, scenario_).value();
  }
  [[nodiscard]] std::string complaint(std::string_view text) const {
    const auto axis = parse_axis(text, scenario_);
    return axis.has_value() ? std::string() : axis.error().message;
  }
};

TEST_F(ScenarioAxis, NamesBodyKeyAndValues) {
  const Axis truck = axis("truck.distance_m=10:11:0.25");
  EXPECT_EQ(truck.what, "truck1.distance_m");
  EXPECT_THAT(truck.values, ElementsAre(10.0, 10.25, 10.5, 10.75, 11.0));
  EXPECT_THAT(axis("ego.speed_mps=8:8:1").values, ElementsAre(8.0));
  EXPECT_THAT(axis("grip=0.3:0.9:0.2").values,
              ElementsAre(0.3, 0.5, DoubleNear(0.7, 1e-12), DoubleNear(0.9, 1e-12)));
}

TEST_F(ScenarioAxis, WhatCannotBeMeantIsRefused) {
  EXPECT_THAT(complaint("truck.distance_m"), HasSubstr("want BODY.KEY=FROM:TO:STEP"));
  EXPECT_THAT(complaint("tram.distance_m=1:2:1"),
              AllOf(HasSubstr("truck1"), HasSubstr("pedestrian1"), HasSubstr("got \"tram\"")));
  EXPECT_THAT(complaint("truck.colour=1:2:1"), HasSubstr("distance_m, offset_m or speed_mps"));
  EXPECT_THAT(complaint("ego.distance_m=1:2:1"), HasSubstr("of the ego"));
  EXPECT_THAT(complaint("actors.7.distance_m=1:2:1"), HasSubstr("one of grip, ego"));
  EXPECT_THAT(complaint("title=1:2:1"), HasSubstr("got \"title\""));
  EXPECT_THAT(complaint("truck1=1:2:1"), HasSubstr("distance_m, offset_m or speed_mps"));
  EXPECT_THAT(complaint("grip=0.9:0.3:0.1"), HasSubstr("TO >= FROM"));
  EXPECT_THAT(complaint("grip=0.3:0.9:0"), HasSubstr("STEP > 0"));
  EXPECT_THAT(complaint("grip=0.3:nan:0.1"), HasSubstr("FROM:TO:STEP"));
  EXPECT_THAT(complaint("grip=0:1:1e-9"), HasSubstr("at most 400 values"));
}

// As a person would write them, not 0.30000000000000004.
TEST_F(ScenarioAxis, ValuesAreShortNumbers) {
  EXPECT_THAT(axis("grip=0.1:0.7:0.1").values, ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7));
}

// By name, or by a kind of which there is one.
TEST_F(ScenarioAxis, ActorsAreCalledByNameOrKind) {
  EXPECT_EQ(actor_called(scenario_, "truck1"), 0U);
  EXPECT_EQ(actor_called(scenario_, "pedestrian"), 1U);
  EXPECT_EQ(actor_called(scenario_, "car"), std::nullopt);
  scenario::Scenario two = scenario_;
  two.actors.push_back(two.actors[0]);
  two.actors.back().id = 2;
  EXPECT_EQ(actor_called(two, "truck"), std::nullopt);
  EXPECT_EQ(actor_called(two, "truck2"), 2U);
}

}  // namespace
}  // namespace saca::eval::scenario_axis_test
