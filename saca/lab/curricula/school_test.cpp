#include "saca/lab/curricula/school.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::curricula::school_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Braking is too late for a standing car; to the left the lane is free.
class SchoolTest : public testing::Test {
 protected:
  SchoolTest() { std::filesystem::create_directories(folder_); }
  ~SchoolTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] Result<std::vector<eval::Curriculum>> two_seeds(
      const std::filesystem::path& folder) {
    return begin_curricula({.saca = {.forecast = {&car_, &harm_}, .clock = &clock_},
                            .intent = &intent::shipped_model(),
                            .made_with = {},
                            .seed = 3,
                            .exact = true,
                            .lies = 0.0,
                            .judging = {.told_draws = 4, .draws = 2}},
                           {}, folder, 2);
  }
  [[nodiscard]] School school(School::EncounterAt at, std::uint64_t count) {
    auto begun = two_seeds(folder_);
    EXPECT_TRUE(begun.has_value());
    return {std::move(begun).value(), std::move(at), count, 2};
  }
  [[nodiscard]] static Result<eval::SuiteEncounter> made(std::uint64_t number) {
    return eval::SuiteEncounter{
        .number = number, .family = "made", .scenario = eval::only_left_helps(), .twin = {}};
  }
  [[nodiscard]] SchoolJournal journal() const {
    return {.file = folder_ / "episodes.journal",
            .title = "a test",
            .display = long_work::ProgressDisplay::silent};
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      fmt::format("saca_school_{}_{}", getpid(),
                  testing::UnitTest::GetInstance()->current_test_info()->name());
  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
};

TEST_F(SchoolTest, EachSeedHasEncountersAndBanksOfItsOwn) {
  School it = school(made, 10);
  EXPECT_THAT(it.numbers_of(4), ElementsAre(4, 14));
  const eval::Episodes episodes = it.teach(4);
  ASSERT_EQ(episodes.of.size(), 2U);
  EXPECT_EQ(episodes.of[1].row.number, 14U);
  EXPECT_EQ(episodes.of[0].row.fault, "");
  EXPECT_THAT(episodes.size[0], ElementsAre(0, 1, 1));
  EXPECT_THAT(episodes.size[1], ElementsAre(0, 1, 1));
  EXPECT_EQ(it.failure(), std::nullopt);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "seed-1/learning.sqlite"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "seed-2/learning.sqlite"));
}

TEST_F(SchoolTest, WhatCannotBeHadIsAFaultAndTeachesNothing) {
  School it = school(
      [](std::uint64_t number) -> Result<eval::SuiteEncounter> {
        return number == 0 ? made(number)
                           : Result<eval::SuiteEncounter>(
                                 Error{Error::Code::out_of_range, "cannot be drawn"});
      },
      10);
  const eval::Episodes episodes = it.teach(0);
  EXPECT_EQ(episodes.of[0].row.fault, "");
  EXPECT_EQ(episodes.of[1].row.fault, "cannot be drawn");
  EXPECT_EQ(episodes.of[1].row.family, "?");
  EXPECT_EQ(episodes.of[1].row.number, 10U);
  EXPECT_THAT(episodes.size[1], ElementsAre(0, 0, 0));
}

// What stands in the journal is not played again, but learnt: the banks are new.
TEST_F(SchoolTest, GoesOnFromTheJournal) {
  School first = school(made, 1);
  const auto taught = taught_by(first, journal());
  ASSERT_TRUE(taught.has_value()) << taught.error().message;
  ASSERT_TRUE(taught.value().has_value());
  ASSERT_EQ(taught.value()->size(), 1U);
  School again = school(
      [](std::uint64_t) -> Result<eval::SuiteEncounter> {
        ADD_FAILURE() << "nothing is left to be played";
        return Error{Error::Code::out_of_range, ""};
      },
      1);
  const auto known = taught_by(again, journal());
  ASSERT_TRUE(known.has_value()) << known.error().message;
  const eval::Episodes& episodes = known.value()->front();
  EXPECT_EQ(episodes.of[1].row.number, 1U);
  EXPECT_EQ(episodes.size, taught.value()->front().size);
  EXPECT_EQ(episodes.of[0].row.risk.runs[1].harm,
            taught.value()->front().of[0].row.risk.runs[1].harm);
}

TEST_F(SchoolTest, AJournalOfOtherEncountersIsRefused) {
  School first = school(made, 1);
  ASSERT_TRUE(taught_by(first, journal()).has_value());
  School other = school(made, 2);  // the second seed begins with encounter 2 now
  const auto refused = taught_by(other, journal());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::malformed);
  EXPECT_THAT(refused.error().message, HasSubstr("line 2: want encounter 2, got 1"));
}

TEST_F(SchoolTest, StopsWhereTheModelFails) {
  School it = school(made, 2);
  SchoolJournal with_model = journal();
  with_model.failure = [] { return Error{Error::Code::unreadable, "the model is gone"}; };
  const auto failed = taught_by(it, with_model);
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().message, "the model is gone");
}

TEST_F(SchoolTest, BanksThatCannotBeMadeAreRefused) {
  std::ofstream(folder_ / "file") << "no folder";
  const auto refused = two_seeds(folder_ / "file");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::curricula::school_test
