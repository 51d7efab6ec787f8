#include "saca/lab/reach_study/needed_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::reach_study::needed_tables_test {
namespace {

using testing::ElementsAre;
using testing::Key;

/// One car ahead that goes on at that speed.
scenario::Scenario behind_a_car(double speed) {
  scenario::Scenario scenario;
  scenario.duration = 1.0;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 10.0};
  scenario.actors = {{.id = 1,
                      .footprint = {.length = 4.5, .width = 1.8},
                      .mass = 1'500.0,
                      .motion = scenario::Script{.start = {.s = 60.0}, .speed = speed}}};
  return scenario;
}

prepare::NamedCar car(const std::string& name) {
  return {name, prepare::default_car()};
}

// Up to 1 m/s beyond the top speed, in steps of 5 m/s.
TEST(NeededTables, AreEachOnceForEachCar) {
  NeededTables needed;
  EXPECT_EQ(needed.add(car("b"), behind_a_car(3.0)), std::nullopt);
  EXPECT_EQ(needed.add(car("b"), behind_a_car(8.0)), std::nullopt);
  EXPECT_EQ(needed.add(car("a"), behind_a_car(0.0)), std::nullopt);
  EXPECT_THAT(needed.by_car(), ElementsAre(Key("a"), Key("b")));
  EXPECT_THAT(needed.by_car().at("b"),
              ElementsAre(Key("car_0mps"), Key("car_10mps"), Key("car_5mps")));
}

// On a quarter of the grip a speed counts twice: 8 m/s as 16.
TEST(NeededTables, ReachFartherWhereTheRoadIsBelievedSlippery) {
  scenario::Scenario slippery = behind_a_car(8.0);
  slippery.grip = 0.225;
  EXPECT_EQ(tables_for(car("a"), behind_a_car(8.0)).value().size(), 3U);
  EXPECT_EQ(tables_for(car("a"), slippery).value().size(), 5U);
}

TEST(NeededTables, NameACarThatNoTableHolds) {
  prepare::NamedCar toy = car("toy");
  toy.car.cg_to_front_axle = 0.1;
  toy.car.cg_to_rear_axle = 0.1;
  EXPECT_THAT(NeededTables().add(toy, behind_a_car(1.0)).value().message,
              testing::StartsWith("toy: "));
}

TEST(NeededTables, AreToldForPeopleAndForPrograms) {
  const ReadyTable ready{.file = "/c/car_0mps.h5", .was_there = true};
  EXPECT_EQ(table_line("compact", "car_0mps", ready),
            "compact            car_0mps             was there\n");
  EXPECT_EQ(table_json("compact", "car_0mps", ready), (nlohmann::json{{"car", "compact"},
                                                                      {"table", "car_0mps"},
                                                                      {"file", "/c/car_0mps.h5"},
                                                                      {"was_there", true}}));
  EXPECT_THAT(table_line("compact", "car_0mps", {}), testing::EndsWith(" solved\n"));
}

}  // namespace
}  // namespace saca::reach_study::needed_tables_test
