#include "saca/lab/family_samples/sample_sheet.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::family_samples::sample_sheet_test {
namespace {

using testing::HasSubstr;

/// A car stands 60 m ahead at 19 m/s; in the twin there is nobody. Vans are
/// parked beside the way, and somebody comes from behind them.
families::FamilySample some_sample() {
  families::FamilySample sample{.scenario = eval::standing_car(19.0, 60.0),
                                .twin = eval::standing_car(19.0, 60.0),
                                .cues = {{world::CueKind::parked_vans, true}}};
  sample.twin.name = "standing_car_twin";
  sample.twin.actors.clear();
  for (scenario::Scenario* const one : {&sample.scenario, &sample.twin}) {
    one->cues = {{.kind = world::CueKind::parked_vans, .p_W = {30.0, -4.25}}};
  }
  return sample;
}

report::SceneView picture(SampleSide side) {
  return picture_of(some_sample(), side, prepare::default_car(), eval::shipped_harm());
}

TEST(SampleSheet, ShowsWhatComesOfDoingNothing) {
  const report::SceneView view = picture(SampleSide::risk);
  EXPECT_EQ(view.title, "standing_car");
  EXPECT_EQ(view.policy, std::nullopt);
  ASSERT_GE(view.lines.size(), 3U);
  EXPECT_EQ(view.lines[0], "19.0 m/s, grip 0.90");
  EXPECT_EQ(view.lines[1], "parked_vans at 30, -4.2 m, and it comes");
  EXPECT_THAT(view.lines[2], HasSubstr("hits"));
  EXPECT_FALSE(view.contacts.empty());
}

TEST(SampleSheet, OfTheTwinNothingTriggersAndNothingComes) {
  const report::SceneView view = picture(SampleSide::twin);
  EXPECT_EQ(view.title, "standing_car_twin");
  EXPECT_EQ(view.lines[0], "19.0 m/s, grip 0.90; never triggers");
  EXPECT_EQ(view.lines[1], "parked_vans at 30, -4.2 m");
  EXPECT_TRUE(view.contacts.empty());
}

TEST(SampleSheet, IsHeadedByTheFamily) {
  families::Family family;
  family.name = "crossing";
  family.title = "A vehicle crosses";
  family.why = "It is common.";
  const report::ContactSheet sheet = empty_sheet(family);
  EXPECT_EQ(sheet.heading, "crossing: A vehicle crosses");
  EXPECT_THAT(sheet.lines, testing::ElementsAre("It is common.", "Drawn: nobody intervenes."));
  EXPECT_TRUE(sheet.scenes.empty());
}

TEST(SampleSheet, ForProgramsASampleHasItsFileWhereItWasWritten) {
  const families::FamilySample sample = some_sample();
  const nlohmann::json out = json_of(chosen(sample, SampleSide::risk), "folder/standing_car.toml");
  EXPECT_EQ(out["name"], "standing_car");
  EXPECT_EQ(out["file"], "folder/standing_car.toml");
  EXPECT_EQ(out["grip"], 0.9);
  EXPECT_EQ(out["ego_speed_mps"], 19.0);
  EXPECT_EQ(out["actors"], 1);
  const nlohmann::json twin = json_of(chosen(sample, SampleSide::twin), "");
  EXPECT_TRUE(twin["file"].is_null());
  EXPECT_EQ(twin["actors"], 0);
}

}  // namespace
}  // namespace saca::family_samples::sample_sheet_test
