#include "saca/lab/danger_study/scenario_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::danger_study::scenario_tables_test {
namespace {

using testing::HasSubstr;

TEST(ScenarioTables, AreOfEachScenariosCar) {
  const installation::Installation here = installation::here_for_test();
  const auto tables = tables_of(here, {"one_way", "intersection_t1"});
  ASSERT_TRUE(tables.has_value()) << tables.error().message;
  ASSERT_EQ(tables.value().needed.by_car().size(), 1U);
  const auto& [car, needed] = *tables.value().needed.by_car().begin();
  EXPECT_EQ(car, "compact_rwd_ev");
  EXPECT_FALSE(needed.empty());
  EXPECT_EQ(tables.value().stores.at(car).place("t"), here.cache / "reach/compact_rwd_ev/t.h5");
}

TEST(ScenarioTables, AreOfAllThatShipUnlessSomeAreNamed) {
  EXPECT_GE(tables_of(installation::here_for_test(), {}).value().needed.by_car().size(), 1U);
  EXPECT_THAT(tables_of(installation::here_for_test(), {"one_wya"}).error().message,
              HasSubstr("one_way"));
}

}  // namespace
}  // namespace saca::danger_study::scenario_tables_test
