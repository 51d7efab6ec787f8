#include "saca/lab/cases/case_build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/crash_records/records_for_test.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::cases::case_build_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class CaseBuildTest : public testing::Test {
 protected:
  const installation::Installation here_ = installation::here_for_test();
  crash_records::ReleaseForTest release_{"case_build"};
  const fs::path journal_ = fs::path(testing::TempDir()) / "case_build.journal";
  CaseBuildRequest request_{
      .folders = {release_.folder().string()},
      .making = {.seed = 2, .judging = {.told_draws = 1, .draws = 2}, .tries = 3},
      .journal = journal_.string(),
      .threads = 1};
  void SetUp() override { fs::remove(journal_); }
  void TearDown() override { fs::remove(journal_); }
};

// A car that ran into a slower one, and one that struck somebody on foot.
TEST_F(CaseBuildTest, EveryRecordIsWorkedOn) {
  const auto built = build_cases(here_, request_);
  ASSERT_TRUE(built.has_value()) << built.error().message;
  ASSERT_TRUE(built.value().has_value());
  const CaseBuild& all = *built.value();
  EXPECT_EQ(all.sources.prospects.size(), 2U);
  EXPECT_EQ(all.tallies.at("rear_end").worked_on, 1);
  EXPECT_EQ(all.tallies.at("pedestrian").worked_on, 1);
  EXPECT_THAT(all.set.problems, IsEmpty());
  EXPECT_LE(all.set.cases.size(), 2U);
  EXPECT_EQ(command_text(request_),
            "cases build --car compact_rwd_ev --seed 2 --draws 2 --told-draws 1 --tries 3");
}

TEST_F(CaseBuildTest, TheJournalOfOtherWorkIsRefused) {
  ASSERT_TRUE(build_cases(here_, request_).has_value());
  request_.making.seed = 3;
  EXPECT_THAT(build_cases(here_, request_).error().message, HasSubstr("case_build.journal"));
}

TEST_F(CaseBuildTest, WhatCannotBeReadIsTold) {
  request_.folders = {"nowhere"};
  EXPECT_THAT(build_cases(here_, request_).error().message, HasSubstr("nowhere"));
  request_.car = "none";
  EXPECT_THAT(build_cases(here_, request_).error().message, HasSubstr("none: no car"));
}

}  // namespace
}  // namespace saca::cases::case_build_test
