#include "saca/lab/eval/suite_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "saca/base/formats/checksummed_hdf5.h"
#include "saca/base/formats/hdf5_rows.h"

namespace saca::eval::suite_file_test {
namespace {

using manoeuvre::PolicyId;

/// One encounter with the runs of three methods, and one that could not be played.
std::vector<SuiteRow> two_rows() {
  SuiteRow good{
      .number = 7, .family = "crossing", .fault = {}, .risk = {}, .twin = {}, .driver = {}};
  good.risk.trigger = 3.25;
  good.risk.best = manoeuvre::Plan{PolicyId::es_b_left, 6.0};
  good.risk.best_harm = 0.125;
  good.risk.published_best_harm = 0.25;
  MethodRun run;
  run.harm = 0.5;
  run.plan = manoeuvre::Plan{PolicyId::t_drift_right, std::nullopt};
  run.met = "truck1";
  MethodRun gentle;
  gentle.plan = manoeuvre::Plan{PolicyId::aeb, std::nullopt, 0.45};
  MethodRun full;
  full.plan = manoeuvre::full_braking;
  good.risk.runs = {run, gentle, full};
  SuiteRow bad{.number = 8,
               .family = "head_on",
               .fault = "broken\nin two",
               .risk = {},
               .twin = {},
               .driver = {}};
  return {good, bad};
}

TEST(SuiteFile, HoldsAColumnForEachNumber) {
  const auto path = std::filesystem::temp_directory_path() / "saca_suite_file_test.h5";
  const std::vector<SuiteRow> rows = two_rows();
  ASSERT_EQ(write_suite(path, rows, {"aeb", "gentle", "full"}, R"({"n": 2})"), std::nullopt);
  const auto read =
      formats::read_sealed_hdf5(path, "saca.suite/1", [](formats::Hdf5Reader& reader) {
        const auto column = [&](const char* name) {
          return formats::read_row(reader, name, 2, formats::Numbers::all);
        };
        EXPECT_EQ(reader.text("about"), R"({"n": 2})");
        EXPECT_THAT(column("number"), testing::ElementsAre(7.0, 8.0));
        EXPECT_THAT(formats::read_lines(reader, "family", 2),
                    testing::ElementsAre("crossing", "head_on"));
        EXPECT_THAT(formats::read_lines(reader, "fault", 2),
                    testing::ElementsAre("", "could not be played: broken in two"));
        EXPECT_EQ(column("risk/trigger_s")[0], 3.25);
        EXPECT_TRUE(std::isnan(column("risk/trigger_s")[1]));
        EXPECT_EQ(column("risk/best_policy")[0], 3.0);
        EXPECT_EQ(column("risk/aeb/harm")[0], 0.5);
        EXPECT_EQ(column("risk/aeb/contact")[0], 1.0);
        EXPECT_EQ(column("risk/aeb/policy")[0], 6.0);
        EXPECT_TRUE(std::isnan(column("risk/aeb/target_speed_mps")[0]));
        EXPECT_TRUE(std::isnan(column("twin/aeb/harm")[0]));
        EXPECT_EQ(column("risk/published_best_harm")[0], 0.25);
        EXPECT_TRUE(std::isnan(column("risk/aeb/strength")[0]));  // a drift has none
        EXPECT_EQ(column("risk/gentle/strength")[0], 0.45);
        EXPECT_EQ(column("risk/full/strength")[0], 1.0);
        return 0;
      });
  EXPECT_TRUE(read.has_value()) << read.error().message;
  std::filesystem::remove(path);
}

TEST(SuiteFile, WhatCannotBeWrittenIsTold) {
  const SuiteRow row{
      .number = 1, .family = "f", .fault = "x", .risk = {}, .twin = {}, .driver = {}};
  const auto problem = write_suite("/nowhere/at/all.h5", {&row, 1}, {"aeb"}, "{}");
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, testing::HasSubstr("/nowhere/at/all.h5"));
}

}  // namespace
}  // namespace saca::eval::suite_file_test
