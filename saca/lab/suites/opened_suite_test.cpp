#include "saca/lab/suites/opened_suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::suites::opened_suite_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class OpenedSuite : public testing::Test {
 protected:
  const Installation here_ = installation::here_for_test();
  const fs::path folder_ = fs::path(testing::TempDir()) / "opened_suite";
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
};

TEST_F(OpenedSuite, ARequestNamesFamiliesTablesAndFolders) {
  const auto family = open_encounters(here_, {.name = "crossing", .count = 3}, "suite");
  ASSERT_TRUE(family.has_value());
  EXPECT_EQ(family.value().count, 3);
  EXPECT_EQ(family.value().inputs.car_name, "compact_rwd_ev");
  EXPECT_THAT(family.value().what, HasSubstr("crossing, calibration split ("));
  EXPECT_TRUE(family.value().at(0).value().twin.has_value());

  const auto table = open_encounters(here_, {.name = "table_2", .count = 4}, "suite");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table.value().count, 4);

  ASSERT_TRUE(fs::copy_file("scenarios/one_way.toml", folder_ / "mine.toml"));
  const auto folder = open_encounters(here_, {.name = folder_.string(), .no_twins = true}, "suite");
  ASSERT_TRUE(folder.has_value());
  EXPECT_EQ(folder.value().count, 1);
  EXPECT_EQ(folder.value().at(0).value().scenario.name, "one_way");
}

TEST_F(OpenedSuite, TwinsAreLeftOutWhereTheyAreNotWanted) {
  const auto all = open_encounters(here_, {.name = "crossing", .no_twins = true}, "suite");
  EXPECT_FALSE(all.value().at(0).value().twin.has_value());
}

TEST_F(OpenedSuite, WhatIsUnknownIsToldWithWhatWasLikelyMeant) {
  EXPECT_THAT(open_encounters(here_, {.name = "fmvss172"}, "suite").error().message,
              HasSubstr("fmvss127"));
  EXPECT_THAT(open_encounters(here_, {.name = "crossing", .car = "none"}, "suite").error().message,
              HasSubstr("none: no car"));
  EXPECT_FALSE(open_encounters(here_, {.name = "100car"}, "suite").has_value());  // no folder
}

TEST_F(OpenedSuite, IsPlayedAndItsRowsAndPageAreLeft) {
  const SuiteRequest request{
      .name = "one_way", .count = 2, .output = (folder_ / "rows.h5").string(), .threads = 1};
  const auto ran = run_suite(here_, request, "suite", {"aeb", "nothing"});
  ASSERT_TRUE(ran.has_value()) << ran.error().message;
  ASSERT_TRUE(ran.value().has_value());
  EXPECT_EQ(ran.value()->rows.size(), 2U);
  EXPECT_EQ(ran.value()->meta.at("meta.version"), "1.2.3");
  EXPECT_EQ(write_rows_and_page(*ran.value(), result_of(*ran.value(), 1), request), std::nullopt);
  EXPECT_TRUE(fs::exists(folder_ / "rows.h5"));
  EXPECT_THAT(read_file(folder_ / "rows.html").value(), HasSubstr("<html"));
}

TEST_F(OpenedSuite, ASurveysEncountersAreASuiteWithoutTwins) {
  const SuiteRequest suite =
      suite_of({.suite = "crossing",
                .draw = {.count = 7, .split = "tuning", .car = "midsize_suv"},
                .journal = "j",
                .threads = 3});
  EXPECT_EQ(suite.name, "crossing");
  EXPECT_EQ(suite.count, 7);
  EXPECT_EQ(suite.split, "tuning");
  EXPECT_EQ(suite.car, "midsize_suv");
  EXPECT_TRUE(suite.no_twins);
  EXPECT_EQ(suite.journal, "j");
  EXPECT_EQ(suite.threads, 3);
}

TEST_F(OpenedSuite, WeightsOfAnotherCarAreRefused) {
  const SuiteRequest request{.name = "one_way",
                             .count = 1,
                             .car = "midsize_suv",
                             .danger = "models/danger/compact_rwd_ev.safetensors",
                             .output = (folder_ / "rows.h5").string(),
                             .threads = 1};
  EXPECT_THAT(run_suite(here_, request, "suite", {"aeb"}).error().message,
              AllOf(HasSubstr("compact_rwd_ev.safetensors: want weights of midsize_suv"),
                    HasSubstr("got those of compact_rwd_ev")));
}

TEST_F(OpenedSuite, ModelsAreThoseOfTheInstallation) {
  SteadyClock clock;
  const auto open = lockstep_models(here_, clock);
  EXPECT_THAT(open("off", "--untuned").error().message, HasSubstr("--untuned"));
  EXPECT_THAT(open("local", "--llm").error().message, HasSubstr("no_host"));
}

}  // namespace
}  // namespace saca::suites::opened_suite_test
