#include "saca/lab/suites/played_encounter.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::suites::played_encounter_test {
namespace {

/// Encounter 7, with a twin of another duration; there is no other.
Result<eval::SuiteEncounter> only_seven(std::uint64_t number) {
  if (number != 7) {
    return Error{Error::Code::out_of_range, "want encounter 7"};
  }
  eval::SuiteEncounter one{.number = 7,
                           .family = "queue",
                           .scenario = eval::car_that_brakes(),
                           .twin = eval::car_that_brakes()};
  one.twin->duration = 3.0;
  return one;
}

TEST(PlayedEncounter, HasTheDrawsAndThePerceptionOfASuite) {
  const auto played = played_encounter(only_seven, {.seed = 5}, 7).value();
  EXPECT_EQ(played.family, "queue");
  EXPECT_EQ(played.world.perception, eval::usual_perception());
  EXPECT_EQ(played.chance.perception, eval::chance_of({.methods = {}, .seed = 5}, 7).perception);
  EXPECT_NE(played.chance.perception, 0U);
  EXPECT_NE(played_encounter(only_seven, {.seed = 6}, 7).value().chance.perception,
            played.chance.perception);
  ASSERT_TRUE(played.twin);
  EXPECT_EQ(played.twin->perception, eval::usual_perception());
}

TEST(PlayedEncounter, IsAsItIsWrittenWhereItIsExact) {
  const auto played = played_encounter(only_seven, {.seed = 5, .exact = true}, 7).value();
  EXPECT_EQ(played.world.perception, scenario::PerceptionModel{});
  EXPECT_EQ(played.chance.perception, 0U);
  EXPECT_EQ(played.chance.actors[0].ahead, 0.0);
}

TEST(PlayedEncounter, IsNotThereWhereTheSourceHasNone) {
  const auto none = played_encounter(only_seven, {}, 8);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().message, "want encounter 7");
}

TEST(PlayedEncounter, IsAStageAndSoIsItsTwin) {
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  const Perceiver perceiver{&car, &harm, &intent::shipped_model()};
  PlayedEncounter played = played_encounter(only_seven, {.seed = 5}, 7).value();
  const encounter::Stage stage = played.stage(perceiver);
  EXPECT_EQ(stage.scenario, &played.world);
  EXPECT_EQ(stage.car, &car);
  EXPECT_EQ(stage.harm, &harm);
  EXPECT_EQ(stage.intent, perceiver.intent);
  EXPECT_EQ(stage.chance.perception, played.chance.perception);
  EXPECT_EQ(played.twin_stage(perceiver).scenario->duration, 3.0);
  EXPECT_EQ(played.twin_stage(perceiver).chance.perception, played.chance.perception);
  played.twin.reset();
  EXPECT_THROW((void)played.twin_stage(perceiver), ContractViolation);
}

}  // namespace
}  // namespace saca::suites::played_encounter_test
