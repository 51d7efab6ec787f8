#include "saca/lab/installation/drawn_suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::installation::drawn_suite_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(DrawnSuite, IsDrawnForItsCarAndSplit) {
  const SurveyRequest request{.suite = "crossing", .draw = {.count = 3, .split = "tuning"}};
  const auto suite = open_suite(here_for_test(), request, "balance");
  ASSERT_TRUE(suite.has_value());
  EXPECT_EQ(suite.value().inputs.car_name, "compact_rwd_ev");
  EXPECT_NE(suite.value().digest, 0U);
  EXPECT_EQ(command_line(request, "balance"),
            "saca balance --suite crossing --count 3 --split tuning --car compact_rwd_ev");
}

TEST(DrawnSuite, EverySplitHasEncountersOfItsOwn) {
  const auto first_of = [](const std::string& split) {
    const auto suite = open_suite(here_for_test(), "crossing", {.split = split}, "suite");
    return scenario::write_scenario(suite.value().source.sample(0).value().scenario);
  };
  EXPECT_EQ(first_of("tuning"), first_of("tuning"));
  EXPECT_NE(first_of("tuning"), first_of("calibration"));
}

TEST(DrawnSuite, WhatIsFoundDependsOnTheCar) {
  const Installation here = here_for_test();
  const auto digest_for = [&](const std::string& car) {
    return open_suite(here, "crossing", {.car = car}, "suite").value().digest;
  };
  EXPECT_EQ(digest_for("compact_rwd_ev"), digest_for("compact_rwd_ev"));
  EXPECT_NE(digest_for("compact_rwd_ev"), digest_for("midsize_suv"));
  EXPECT_THAT(open_suite(here, "crossing", {.car = "none"}, "suite").error().message,
              HasSubstr("none: no car"));
}

TEST(DrawnSuite, TheTestSplitIsUsedOnlyWithALogOfIt) {
  const Installation here = here_for_test();
  const fs::path log = fs::path(testing::TempDir()) / "drawn_suite_test.log";
  fs::remove(log);
  DrawRequest draw{.count = 2, .split = "test"};
  EXPECT_FALSE(open_suite(here, "crossing", draw, "suite").has_value());
  draw.test_log = log.string();
  ASSERT_TRUE(open_suite(here, "crossing", draw, "suite").has_value());
  EXPECT_THAT(read_file(log).value(),
              HasSubstr("saca suite --suite crossing --count 2 --split test"));
  fs::remove(log);
}

TEST(DrawnSuite, OtherNamesAreToldWithAnUnknownOne) {
  EXPECT_THAT(open_suite(here_for_test(), "100cra", {}, "suite", {"100car"}).error().message,
              HasSubstr("100car"));
}

TEST(Survey, TriesAllPoliciesInEachEncounter) {
  const Installation here = here_for_test();
  const fs::path journal = fs::path(testing::TempDir()) / "drawn_suite_survey.journal";
  fs::remove(journal);
  const SurveyRequest request{.suite = "one_way",
                              .draw = {.count = 2, .split = "tuning"},
                              .journal = journal.string(),
                              .threads = 1};
  const auto suite = open_suite(here, request, "balance");
  ASSERT_TRUE(suite.has_value());
  const auto found = survey(here, suite.value(), request);
  ASSERT_TRUE(found.has_value());
  ASSERT_TRUE(found.value().has_value());
  ASSERT_EQ(found.value()->size(), 2U);
  // They are eval::look_into's own.
  const auto sample = suite.value().source.sample(1).value();
  const auto again = eval::look_into({&sample.scenario, 1}, suite.value().inputs.car,
                                     suite.value().inputs.harm, 1);
  EXPECT_EQ(found.value()->at(1).harm, again.front().harm);
  EXPECT_TRUE(found.value()->at(1).time.has_value());
  EXPECT_TRUE(fs::exists(journal));
  fs::remove(journal);
}

}  // namespace
}  // namespace saca::installation::drawn_suite_test
