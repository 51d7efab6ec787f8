#include "saca/lab/banks/recall_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::recall_calibration_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

TEST(CalibrationCases, AreReadOrTheFileIsTold) {
  const EmptyFolder folder;
  const std::string some = folder.with_cases("some", {best_is(PolicyId::aeb, 10.0, "a")});
  const std::string none = folder.with_cases("none", {});
  const auto read = read_calibration_cases(some, {some, none});
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read.value().cases.size(), 1U);
  EXPECT_EQ(read.value().check_cases.size(), 1U);
  const auto empty = read_calibration_cases(none, {});
  ASSERT_FALSE(empty.has_value());
  EXPECT_EQ(empty.error().code, Error::Code::malformed);
  EXPECT_EQ(empty.error().message, none + ": want cases, got none");
  EXPECT_FALSE(read_calibration_cases(some, {folder.file("missing")}).has_value());
}

// Two cases of other encounters at the same speed that say the same: each speaks for the other with
// a share of 1 / 1.3 (memory::Experience::doubt). The third is far from both and speaks for another
// policy, so what is recalled for it, if anything, is wrong.
CalibrationCases three_cases() {
  return {.file = "folder/cases.jsonl",
          .cases = {best_is(PolicyId::aes_left, 10.0, "a"), best_is(PolicyId::aes_left, 10.0, "b"),
                    best_is(PolicyId::aeb, 30.0, "c")},
          .check_files = {},
          .check_cases = {}};
}

TEST(RecallCalibration, HoldsCasesAgainstOneAnother) {
  const RecallCalibration calibration = calibrate_recalls(three_cases(), 1, 2);
  EXPECT_EQ(calibration.num_cases, 3U);
  ASSERT_EQ(calibration.within.size(), 3U);
  EXPECT_TRUE(calibration.within[0].in_truth && calibration.within[1].in_truth);
  EXPECT_FALSE(calibration.within[2].in_truth);
  EXPECT_NEAR(calibration.within[0].share, 1.0 / 1.3, 1e-6);
  EXPECT_DOUBLE_EQ(calibration.least_shares[0].part, 0.98);
  ASSERT_TRUE(calibration.least_shares[0].share);
  EXPECT_NEAR(*calibration.least_shares[0].share, 1.0 / 1.3, 1e-6);
  EXPECT_FALSE(calibration.checks);
}

TEST(RecallCalibration, HoldsOtherCasesAgainstThem) {
  CalibrationCases cases = three_cases();
  cases.check_files = {"x/one.jsonl", "two.jsonl"};
  cases.check_cases = {best_is(PolicyId::aes_left, 10.0, "d")};
  const RecallCalibration calibration = calibrate_recalls(cases, 1, 1);
  EXPECT_EQ(calibration.check_files, "one.jsonl, two.jsonl");
  ASSERT_TRUE(calibration.checks);
  ASSERT_EQ(calibration.checks->size(), 1U);
  EXPECT_TRUE(calibration.checks->front().in_truth);
}

/// Four queries; confidence is above 0.9 from a share of 0.73 on and above 0.7 from 0.62 on.
RecallCalibration four_queries() {
  return {.file = "folder/cases.jsonl",
          .num_cases = 9,
          .seed = 5,
          .within = {{.share = 0.9, .as_told = true, .in_truth = true},
                     {.share = 0.8, .in_truth = true, .braking = true},
                     {.share = 0.8},
                     {.share = 0.65, .in_truth = true, .random_one = true}},
          .least_shares = {{{0.98, std::nullopt}, {0.95, 0.73}}},
          .check_files = "check.jsonl",
          .checks = std::nullopt};
}

TEST(RecallCalibration, IsPrintedForPrograms) {
  RecallCalibration calibration = four_queries();
  const nlohmann::json out = json_of(calibration, "1.2.3");
  EXPECT_EQ(out.at("meta.command"), "saca memory calibrate CASES --seed 5");
  EXPECT_EQ(out.at("meta.seed"), "5");
  EXPECT_EQ(out.at("meta.version"), "1.2.3");
  EXPECT_EQ(out.at("memory.transfer.cases"), 9);
  const std::string place = "memory.transfer.within";
  EXPECT_EQ(out.at(place + ".queries"), 4);
  EXPECT_DOUBLE_EQ(out.at(place + ".above_0.9.coverage"), 0.75);
  EXPECT_DOUBLE_EQ(out.at(place + ".above_0.9.in_truth"), 2.0 / 3.0);
  EXPECT_EQ(out.at(place + ".above_0.9.in_truth.n"), 3);
  EXPECT_DOUBLE_EQ(out.at(place + ".0.7_to_0.9.random_one"), 1.0);
  // Exact (Clopper and Pearson): of one that holds the lower end is 0.025.
  EXPECT_NEAR(out.at(place + ".0.7_to_0.9.in_truth.lo"), 0.025, 1e-6);
  EXPECT_DOUBLE_EQ(out.at(place + ".0.7_to_0.9.in_truth.hi"), 1.0);
  EXPECT_EQ(out.at(place + ".below_0.7.in_truth.n"), 0);
  EXPECT_TRUE(out.at("memory.transfer.least_share_for_0.98").is_null());
  EXPECT_EQ(out.at("memory.transfer.least_share_for_0.95"), 0.73);
  EXPECT_FALSE(out.contains("memory.transfer.check.queries"));
  calibration.checks.emplace();
  const nlohmann::json checked = json_of(calibration, "");
  EXPECT_EQ(checked.at("meta.command"), "saca memory calibrate CASES --check CASES --seed 5");
  EXPECT_EQ(checked.at("memory.transfer.check.queries"), 0);
}

TEST(RecallCalibration, IsPrintedForPeople) {
  RecallCalibration calibration = four_queries();
  calibration.checks.emplace();
  const std::string text = text_of(calibration);
  EXPECT_THAT(text, testing::StartsWith("\nfolder/cases.jsonl, each held against all others: 4 "
                                        "queries in which the choice matters\nconfidence "));
  EXPECT_THAT(text, HasSubstr("\nabove 0.9        75.0 %"));
  EXPECT_THAT(text, HasSubstr("\n0.7 to 0.9       25.0 %   100.0 % (2.5 to 100.0)"));
  EXPECT_THAT(text, HasSubstr("\nup to 0.7         0.0 %                        -"));
  EXPECT_THAT(text, HasSubstr("\n98 % of all recalls transfer from a share of none on; confidence "
                              "there is none\n95 % of all recalls transfer from a share of 0.730 "
                              "on; confidence there is 0.90\n"));
  EXPECT_THAT(text, HasSubstr("\ncheck.jsonl: 0 queries in which"));
}

}  // namespace
}  // namespace saca::banks::recall_calibration_test
