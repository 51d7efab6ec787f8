#include "saca/lab/cases/case_stage.h"

#include <gtest/gtest.h>

#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::case_stage_test {
namespace {

// FNV-1a of 64 bits, as its authors publish it.
TEST(CaseStage, NumbersARecordByItsName) {
  EXPECT_EQ(number_of_record(""), 0xcbf29ce484222325U);
  EXPECT_EQ(number_of_record("a"), 0xaf63dc4c8601ec8cU);
}

TEST(CaseStage, IsPlayedWithTheToolsAsItIsPerceived) {
  const CaseTools tools = shipped().tools();
  const scenario::Scenario drawn;
  const scenario::Scenario world = case_world(drawn, 1);
  EXPECT_FALSE(world.perception == drawn.perception) << "what is drawn is not seen without error";
  const encounter::Stage stage = case_stage(world, tools, 1, "a");
  EXPECT_EQ(stage.scenario, &world);
  EXPECT_EQ(stage.car, &shipped().car);
  EXPECT_EQ(stage.harm, &shipped().harm);
  EXPECT_EQ(stage.intent, &intent::shipped_model());
}

TEST(CaseStage, ChanceIsDrawnBySeedAndName) {
  const CaseTools tools = shipped().tools();
  const scenario::Scenario world;
  const auto seed_of = [&](std::uint64_t seed, const std::string& name) {
    return case_stage(world, tools, seed, name).chance.perception;
  };
  EXPECT_EQ(seed_of(1, "a"), seed_of(1, "a"));
  EXPECT_NE(seed_of(1, "a"), seed_of(1, "a_twin"));
  EXPECT_NE(seed_of(1, "a"), seed_of(2, "a"));
}

}  // namespace
}  // namespace saca::cases::case_stage_test
