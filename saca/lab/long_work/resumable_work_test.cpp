#include "saca/lab/long_work/resumable_work.h"

#include <gmock/gmock.h>

#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>

#include "saca/base/core/file.h"

namespace saca::long_work::resumable_work_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LongWork : public testing::Test {
 protected:
  const std::filesystem::path journal_ =
      std::filesystem::path(testing::TempDir()) / "resumable_work" /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".journal");
  void SetUp() override { std::filesystem::remove_all(journal_); }
  void TearDown() override { std::filesystem::remove_all(journal_); }

  /// Squares of 0, 1, ...; `worked_on` learns which were worked out.
  [[nodiscard]] ResumableWork<int> squares(std::size_t count) {
    return {.journal = journal_.string(),
            .title = "squares",
            .progress = "squares",
            .unit = "numbers",
            .count = count,
            .display = ProgressDisplay::silent,
            .row =
                [this](std::size_t number) {
                  const std::lock_guard lock(mutex_);
                  worked_on_.insert(number);
                  return static_cast<int>(number * number);
                },
            .line_of = [](const int& row) { return std::to_string(row); },
            .row_from = [](const std::string& line) -> Result<int> {
              int row = 0;
              const auto read = std::from_chars(line.data(), line.data() + line.size(), row);
              if (read.ec != std::errc{}) {
                return Error{Error::Code::malformed, "want a number, got '" + line + "'"};
              }
              return row;
            }};
  }

  std::mutex mutex_;
  std::set<std::size_t> worked_on_;
};

TEST_F(LongWork, GoesOnWhereItsJournalEnds) {
  EXPECT_THAT(rows_of(squares(3)).value().value(), ElementsAre(0, 1, 4));
  worked_on_.clear();
  EXPECT_THAT(rows_of(squares(5)).value().value(), ElementsAre(0, 1, 4, 9, 16));
  EXPECT_THAT(worked_on_, ElementsAre(3, 4));
}

TEST_F(LongWork, TakesNoMoreOfALongerJournalThanIsAskedFor) {
  ASSERT_TRUE(rows_of(squares(5)).has_value());
  EXPECT_THAT(rows_of(squares(2)).value().value(), ElementsAre(0, 1));
}

TEST_F(LongWork, GivesTheSameByAnyNumberOfThreads) {
  auto work = squares(100);
  work.threads = 3;
  const auto rows = rows_of(work).value().value();
  ASSERT_EQ(rows.size(), 100U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], static_cast<int>(i * i));
  }
}

// A failure is looked for after so many rows as are worked on at once.
TEST_F(LongWork, WorksOnSoManyAtOnce) {
  auto work = squares(9);
  work.at_once = 4;
  work.failure = [] { return std::optional(Error{Error::Code::unreadable, "server: gone"}); };
  EXPECT_FALSE(rows_of(work).has_value());
  EXPECT_THAT(worked_on_, ElementsAre(0, 1, 2, 3));
}

TEST_F(LongWork, RefusesAJournalOfOtherWorkAndALineThatIsNoRow) {
  ASSERT_TRUE(rows_of(squares(1)).has_value());
  auto other = squares(1);
  other.title = "cubes";
  EXPECT_THAT(rows_of(other).error().message, HasSubstr(journal_.string()));
  ASSERT_EQ(write_file(journal_, "squares\n0\none\n"), std::nullopt);
  EXPECT_EQ(rows_of(squares(3)).error().message,
            journal_.string() + ": line 3: want a number, got 'one'");
}

TEST_F(LongWork, StopsAtAFailureAndKeepsWhatWasBefore) {
  auto work = squares(4);
  work.failure = [this]() -> std::optional<Error> {
    return worked_on_.size() < 3 ? std::nullopt
                                 : std::optional(Error{Error::Code::unreadable, "server: gone"});
  };
  EXPECT_EQ(rows_of(work).error().message, "server: gone");
  worked_on_.clear();
  EXPECT_THAT(rows_of(squares(4)).value().value(), ElementsAre(0, 1, 4, 9));
  EXPECT_THAT(worked_on_, ElementsAre(2, 3));
}

using LongWorkDeathTest = LongWork;

/// An interrupt stays one: each gets a process of its own.
TEST_F(LongWorkDeathTest, StopsAtAnInterruptAndGoesOnFromThere) {
  for (const bool spoilt : {false, true}) {
    std::filesystem::remove_all(journal_);
    auto work = squares(9);
    const auto row = work.row;
    work.spoilt_by_interrupt = spoilt;
    work.row = [row](std::size_t number) {
      if (number == 2) {
        (void)std::raise(SIGINT);
      }
      return row(number);
    };
    EXPECT_EXIT(
        {
          watch_for_interrupt();
          const auto rows = rows_of(work);
          std::_Exit(rows.has_value() && !rows.value() ? EXIT_SUCCESS : EXIT_FAILURE);
        },
        testing::ExitedWithCode(EXIT_SUCCESS), "");
    EXPECT_EQ(read_file(journal_).value(), spoilt ? "squares\n0\n1\n" : "squares\n0\n1\n4\n");
  }
}

}  // namespace
}  // namespace saca::long_work::resumable_work_test
