#include "saca/lab/suites/encounter_source.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::suites::encounter_source_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

const manoeuvre::Car& shipped() {
  static const manoeuvre::Car car = prepare::default_car();
  return car;
}

EncounterDraw draw_of(int count) {
  return {.car_name = "compact_rwd_ev", .car = &shipped(), .count = count};
}

fs::path empty_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("saca_encounter_source_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(FolderSource, HasItsScenariosByRisingName) {
  const fs::path folder = empty_folder("two");
  fs::copy_file("scenarios/intersection_t1.toml", folder / "b.toml");
  fs::copy_file("scenarios/intersection_t1.toml", folder / "a.toml");
  ASSERT_FALSE(write_file(folder / "readme.txt", "no scenario").has_value());
  const auto source = folder_source(folder, draw_of(10));
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ(source.value().count, 2);
  EXPECT_EQ(source.value().at(0).value().family, "a");
  EXPECT_EQ(source.value().at(1).value().family, "b");
  EXPECT_EQ(source.value().at(1).value().number, 1U);
  EXPECT_FALSE(source.value().at(1).value().twin.has_value());
  EXPECT_EQ(source.value().at(2).error().message, "want an encounter below 2, got 2");
  EXPECT_THAT(source.value().what, MatchesRegex("folder .*_two \\([0-9a-f]{16}\\)"));
  EXPECT_EQ(folder_source(folder, draw_of(1)).value().count, 1);
  EncounterDraw other = draw_of(10);
  other.played_with.add("another mass of the same car");
  EXPECT_NE(folder_source(folder, other).value().what, source.value().what);
  EXPECT_EQ(source.value().at(0).value().scenario.car, draw_of(10).car_name);
}

TEST(FolderSource, RefusesAnEmptyFolderAndNamesABrokenFile) {
  const fs::path folder = empty_folder("broken");
  EXPECT_EQ(folder_source(folder, draw_of(1)).error().message,
            folder.string() + ": want a folder with scenarios (*.toml), got none");
  ASSERT_FALSE(write_file(folder / "a.toml", "name = 7\n").has_value());
  EXPECT_THAT(folder_source(folder, draw_of(1)).error().message, HasSubstr("a.toml"));
}

TEST(HundredCarSource, HasTheEventsThatCanBeRebuilt) {
  const auto source = hundred_car_source({"saca/lab/recordings/testdata"}, draw_of(10));
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ(source.value().count, 1);
  EXPECT_EQ(source.value().at(0).value().family, "Near-Crash");
  EXPECT_EQ(source.value().at(0).value().scenario.car, "compact_rwd_ev");
  EXPECT_THAT(source.value().notes, ElementsAre("1 of 1 events were rebuilt; refused: ."));
  EXPECT_THAT(source.value().what, HasSubstr("100-Car study ("));
}

TEST(HundredCarSource, WantsOneFolder) {
  EXPECT_EQ(hundred_car_source({"a", "b"}, draw_of(1)).error().message,
            "--data: want the folder of the 100-Car study's release, got 2 folders");
  EXPECT_EQ(hundred_car_source({"no_such_folder"}, draw_of(1)).error().code,
            Error::Code::unreadable);
}

// The one-way road is one condition: the second encounter is the first again.
TEST(PaperTableSource, HasItsConditionsOverAndOver) {
  const auto source = paper_table_source("table_3", "scenarios", draw_of(7), Twins::played);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ(source.value().count, 7);
  const auto first = source.value().at(0).value();
  const auto second = source.value().at(1).value();
  EXPECT_EQ(second.number, 1U);
  EXPECT_EQ(scenario::write_scenario(first.scenario), scenario::write_scenario(second.scenario));
  EXPECT_TRUE(first.twin.has_value());
  const auto alone =
      paper_table_source("table_3", "scenarios", draw_of(7), Twins::left_out).value();
  EXPECT_FALSE(alone.at(0).value().twin.has_value());
  EXPECT_EQ(alone.what, source.value().what);
  EncounterDraw other = draw_of(7);
  other.played_with.add("another car");
  EXPECT_NE(paper_table_source("table_3", "scenarios", other, Twins::played).value().what,
            alone.what);
}

TEST(DrawnSource, IsTheSuiteWithTwinsOrWithout) {
  const auto suite = eval::SuiteSource::open({.scenarios = "scenarios",
                                              .suite = "crossing",
                                              .split = families::Split::tuning,
                                              .test_log = std::nullopt,
                                              .car = "compact_rwd_ev",
                                              .footprint = manoeuvre::footprint(shipped())});
  ASSERT_TRUE(suite.has_value()) << suite.error().message;
  const EncounterSource source = drawn_source(suite.value(), "crossings", 3, Twins::played);
  EXPECT_EQ(source.what, "crossings");
  EXPECT_EQ(source.count, 3);
  const auto one = source.at(2).value();
  EXPECT_EQ(one.number, 2U);
  EXPECT_EQ(one.family, "crossing");
  EXPECT_EQ(scenario::write_scenario(one.scenario),
            scenario::write_scenario(suite.value().sample(2).value().scenario));
  EXPECT_TRUE(one.twin.has_value());
  EXPECT_FALSE(
      drawn_source(suite.value(), "crossings", 3, Twins::left_out).at(2).value().twin.has_value());
}

TEST(NamesBesideSuites, AreSorted) {
  const fs::path folder = empty_folder("protocols");
  ASSERT_FALSE(write_file(folder / "a_rule.toml", "").has_value());
  const auto names = names_beside_suites(folder);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(names, testing::IsSupersetOf({"100car", "a_rule", "table_2", "table_3", "traffic"}));
}

}  // namespace
}  // namespace saca::suites::encounter_source_test
