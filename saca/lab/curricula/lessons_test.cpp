#include "saca/lab/curricula/lessons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"
#include "saca/lab/long_work/folder_hold.h"

namespace saca::curricula::lessons_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LessonsTest : public testing::Test {
 protected:
  const installation::Installation here_ = installation::here_for_test();
  LearnRequest request_{.from = {.name = "one_way", .count = 2, .threads = 1},
                        .seeds = 1,
                        .lies = 0.0,
                        .empty_memory = true,
                        .folder = (fs::path(testing::TempDir()) / "lessons").string()};
  void SetUp() override {
    fs::remove_all(request_.folder);
    fs::create_directories(request_.folder);
  }
  void TearDown() override { fs::remove_all(request_.folder); }
};

TEST_F(LessonsTest, AreTaughtAndGoOnFromTheirJournal) {
  auto opened = open_lessons(here_, request_);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  Lessons lessons = std::move(opened).value();
  EXPECT_EQ(lessons.count, 2U);
  EXPECT_TRUE(lessons.start.empty());
  EXPECT_THAT(lessons.digest.start, HasSubstr("0 cases"));
  const auto all = taught(here_, lessons, request_);
  ASSERT_TRUE(all.has_value()) << all.error().message;
  ASSERT_TRUE(all.value().has_value());
  EXPECT_EQ(all.value()->size(), 2U);
  EXPECT_TRUE(fs::exists(journal_place(request_)));
  EXPECT_TRUE(fs::exists(fs::path(request_.folder) / "seed-1"));
  const auto written = read_file(journal_place(request_)).value();
  EXPECT_EQ(taught(here_, lessons, request_).value()->size(), 2U);
  EXPECT_EQ(read_file(journal_place(request_)).value(), written);  // nothing was played again
}

TEST_F(LessonsTest, TheJournalOfOtherLessonsIsRefused) {
  Lessons lessons = std::move(open_lessons(here_, request_)).value();
  ASSERT_TRUE(taught(here_, lessons, request_).has_value());
  LearnRequest other = request_;
  other.from.seed = 7;
  EXPECT_THAT(taught(here_, lessons, other).error().message, HasSubstr("episodes.journal"));
}

// Two programs would replace each other's banks and journal.
TEST_F(LessonsTest, AFolderInWhichSomebodyLearnsIsRefused) {
  Lessons lessons = std::move(open_lessons(here_, request_)).value();
  std::optional<long_work::FolderHold> other = long_work::FolderHold::unless_held(request_.folder);
  ASSERT_TRUE(other.has_value());
  const auto refused = taught(here_, lessons, request_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr(request_.folder));
  EXPECT_TRUE(fs::is_empty(request_.folder)) << "nothing was touched";
  other.reset();
  EXPECT_TRUE(taught(here_, lessons, request_).has_value());
  EXPECT_TRUE(long_work::FolderHold::unless_held(request_.folder).has_value())
      << "it was given back";
}

TEST_F(LessonsTest, ABeginningIsTheShippedCasesUnlessAnotherIsNamed) {
  request_.empty_memory = false;
  EXPECT_FALSE(open_lessons(here_, request_).value().start.empty());
  request_.from.thinking.memory = "nowhere.sqlite";
  EXPECT_THAT(open_lessons(here_, request_).error().message, HasSubstr("nowhere.sqlite"));
}

TEST_F(LessonsTest, EverySeedNeedsAnEncounter) {
  const fs::path folder = fs::path(request_.folder) / "scenarios";
  fs::create_directories(folder);
  ASSERT_TRUE(fs::copy_file("scenarios/one_way.toml", folder / "one.toml"));
  request_.from.name = folder.string();
  request_.from.no_twins = true;
  request_.seeds = 3;
  EXPECT_THAT(open_lessons(here_, request_).error().message,
              HasSubstr("want an encounter for each of 3 seeds, got 1"));
}

}  // namespace
}  // namespace saca::curricula::lessons_test
